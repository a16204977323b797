// Points that start at an unstable equilibrium of an autonomous model. There they rest until
// what rounding leaves has grown: a map shows the one, the other, or something between.
#pragma once

#include <cstddef>
#include <vector>

#include "plan/plan.hpp"

namespace gearsweep {

// Whether a point of a plan that is autonomous is one that starts at this state of the plan's
// model: its field vanishes to rounding, and an eigenvalue of its Jacobian has a positive real
// part. Both hold in any units.
bool starts_unstable(const Plan& plan, std::size_t point, const std::vector<double>& start);

}  // namespace gearsweep
