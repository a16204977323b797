// Why a point fails before its first step.
#pragma once

#include <cstddef>
#include <string>

#include "plan/plan.hpp"

namespace gearsweep {

// The part of an equation that is no finite number where the point starts, with the states there:
// "at its start, x = 0, y = 0, x/sqrt(x*x + y*y) is 0/0 in the equation of 'x'". Empty where all
// equations are finite, and for a model that is no file of equations.
std::string failure_at_start(const Plan& plan, std::size_t point);

}  // namespace gearsweep
