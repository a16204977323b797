// The settle kernel's arithmetic for gear5, compiled for the host: the same headers, without
// contraction.
#pragma once

#include <vector>

#include "plan/plan.hpp"

namespace gearsweep {

// The state of a point of a gear5 study after `periods` periods from its own start, in the study's
// precision.
std::vector<double> step_on_host(const Plan& plan, std::size_t point, std::size_t periods);

}  // namespace gearsweep
