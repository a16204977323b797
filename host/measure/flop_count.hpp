// The floating-point operations of a step.
#pragma once

#include "study/study.hpp"

namespace gearsweep {

// Counts one point over one Runge-Kutta step with the study's model and options, all of its states,
// and with so many tangent vectors; what counts is said at StepWork (model/model.hpp). The
// correction of a step that crosses a contact and what observables do with a step are not in it.
double flops_per_step(const Study& study, std::size_t tangents);

}  // namespace gearsweep
