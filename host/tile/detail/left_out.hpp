// The exponents of states that are not integrated (plan/passive_states.hpp).
#pragma once

#include "engine/engine.hpp"

namespace gearsweep {

// Where one of them is larger than the largest exponent of a finished tile's point, it takes its
// place. It is known to rounding, so its error is 0.
void add_left_out_exponents(const Plan& plan, const Tile& tile, TileResult* result);

}  // namespace gearsweep
