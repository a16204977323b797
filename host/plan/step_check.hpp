// Points whose motion has come to where the study's step is too long for it. A study that finds its
// step learns it from motions near their beginning. A motion that grows far beyond these may be
// faster there, and held by the method alone, so that it looks bounded and is not.
#pragma once

#include <cstddef>
#include <vector>

#include "plan/plan.hpp"

namespace gearsweep {

// Whether that is so of a point that has come to this state of the plan's model at phase 0, of a
// study that found its step: the state lies beyond where the motions were that it was found by, and
// the error of a step is a hundred times as large there as the search allows, told by one step
// against two halves. False of a study whose step was given. Takes a millisecond where the state
// lies beyond.
bool has_outgrown_step(const Plan& plan, std::size_t point, const std::vector<double>& state);

}  // namespace gearsweep
