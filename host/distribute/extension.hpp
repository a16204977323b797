// What a tile's longer windows need: its undecided points as a tile of their own, and their
// verdicts put back. Private to this folder.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

// Positions in the tile of the points whose kind of motion is not yet known.
std::vector<std::size_t> undecided_positions(const Study& study, const TileResult& result);

// The points at these positions (ascending) as a tile, with the work of this window.
Tile part_of(const Plan& plan, const Tile& tile, const std::vector<std::size_t>& positions,
             const Window& window);

// [position][state]: where these points ended.
std::vector<double> end_states(const TileResult& result, const std::vector<std::size_t>& positions);

// Replaces what `whole` says of these points' kind of motion, exponents and recurrence (observables
// of kind tangent and orbit) by what `part` says. Averages, extremes and samples stay those of the
// study's own window, and so does the final state; a point that diverged in the longer window has
// diverged.
void adopt_verdicts(const Study& study, const std::vector<std::size_t>& positions,
                    const TileResult& part, TileResult* whole);

}  // namespace gearsweep
