// What a run says of a point whose parameters are uncertain.
#pragma once

#include <string>

#include "engine/result.hpp"

namespace gearsweep {

// For a study of one point: each quantity's mean, deviation and percentiles over the draws, and its
// Sobol indices as a table. Empty for others, whose maps tell.
std::string describe_tolerances(const SweepResult& result);

}  // namespace gearsweep
