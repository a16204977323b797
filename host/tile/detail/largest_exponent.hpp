// The largest exponent, where the first tangent vector does not have it.
#pragma once

#include "engine/engine.hpp"

namespace gearsweep {

// A larger one takes its place, at each point of a finished tile:
// - the first of all exponents, where the study asks for these, too: in a short record the first
//   tangent vector may still be turning towards the direction that grows fastest, while another one
//   grew faster. The error has the difference in it.
// - that of states that are not integrated (plan/passive_states.hpp). It is known to rounding, so
//   the error is 0.
void complete_largest_exponents(const Plan& plan, const Tile& tile, TileResult* result);

}  // namespace gearsweep
