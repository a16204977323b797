// What signals show where a motion slides along a surface on which they jump.
#pragma once

#include <set>

#include "expression/expression.hpp"

namespace gearsweep {

// The signal as the mean of its values on both sides of each surface, by the shares of the time
// that a sliding motion has on them (A. F. Filippov, Differential Equations with Discontinuous
// Righthand Sides, 1988). sides: symbols of surfaces, 0 below and 1 above, of a staircase whole
// numbers; their fractions are the shares. Each term of a sum is taken by itself, since one doubles
// with each of its surfaces.
NodeId mean_of_sides(ExpressionGraph* graph, NodeId signal, const std::set<NodeId>& sides);

}  // namespace gearsweep
