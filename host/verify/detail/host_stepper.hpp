// The settle kernel's arithmetic for gear5, compiled for the host: the same headers, without
// contraction.
#pragma once

#include <vector>

#include "plan/plan.hpp"

namespace gearsweep {

// A gear5 study whose kernel is the one that the host's compiler has read: with all options and all
// parameters, where a study's own has those of the study.
Study with_whole_kernel(Study study);

// The state of a point of such a study after `periods` periods from its own start, in the study's
// precision.
std::vector<double> step_on_host(const Plan& plan, std::size_t point, std::size_t periods);

}  // namespace gearsweep
