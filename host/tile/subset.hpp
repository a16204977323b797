// Some of a tile's points as a tile of their own, and their answers put back. Positions are places
// in the tile, those of one phase grid together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

// Which of the tile's phase grids the point at a position has.
std::size_t grid_of(const Tile& tile, std::size_t position);

// The points at these positions, with the work of so many periods.
Tile subset_of(const Plan& plan, const Tile& tile, const std::vector<std::size_t>& positions,
               std::size_t periods);

// [point of the tile][state]: where each starts when no predecessor says.
std::vector<double> own_initial_states(const Plan& plan, const Tile& tile);

// [position][state]: where these points ended.
std::vector<double> end_states(const TileResult& result, const std::vector<std::size_t>& positions);

// A tile's result without any answers yet.
TileResult empty_result(const Study& study, std::size_t points);

// Whether the answer of a tile keeps its final states: where points of a later stage start there.
bool has_final_states(const Study& study, const Tile& tile);

// Throws InputError when what a journal has of this tile is not of its size.
void require_fit(const Study& study, const Tile& tile, const TileResult& result);

// Puts the answers of a subset into those of its tile. A subset that has fewer samples than the
// tile is a periodic orbit's record, and is repeated.
void put_subset(const Study& study, const TileResult& subset,
                const std::vector<std::size_t>& positions, TileResult* whole);

}  // namespace gearsweep
