// What a tile's longer windows need: which points go on into them, and what is taken over from
// them.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

// Positions in the tile of the points whose kind of motion is not yet known.
std::vector<std::size_t> undecided_positions(const Study& study, const TileResult& result);

// Replaces what `whole` says of these points' kind of motion, exponents and recurrence (verdicts)
// by what `subset` says; the boxes of their sections are among these. Averages, extremes and
// samples stay those of the study's own window, and so does the final state; a point that diverged
// in the replayed window has diverged.
void adopt_verdicts(const Study& study, const std::vector<std::size_t>& positions,
                    const TileResult& subset, TileResult* whole);
// The same after a longer window, whose steps the observers saw: statistics are adopted, too. Where
// there is no clock so are averages and extremes: a window that does not tell a cycle may be a part
// of it.
void adopt_longer_window(const Study& study, const std::vector<std::size_t>& positions,
                         const TileResult& subset, TileResult* whole);

}  // namespace gearsweep
