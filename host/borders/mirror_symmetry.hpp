// The symmetry of a model by which a motion seen in a mirror, half a forcing period later, is a
// motion of the same model: its field has f(-x, phase + 1/2) = -f(x, phase).
//
// A mirrored orbit has x(t + k T/2) = -x(t), of an odd period k, and is a fixed point of the map H,
// which carries a state half of that way and mirrors it. The return map is H twice. Where the
// mirrored orbit breaks into a pair of others a multiplier of H is -1 (J. W. Swift, K. Wiesenfeld,
// Physical Review Letters 52 (1984) 705-708).
#pragma once

#include "borders/parameter_plane.hpp"

namespace gearsweep {

// Whether the model has it everywhere in the plane, judged by its field at chosen states and
// phases. False of models whose field jumps with a state.
bool is_mirrored(const ParameterPlane& plane);

}  // namespace gearsweep
