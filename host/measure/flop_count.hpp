// The floating-point operations of a step, counted by running the kernel's own source on numbers
// that count.
#pragma once

#include "study/study.hpp"

namespace gearsweep {

// Of one point over one Runge-Kutta step of gear5 with the study's options, and with so many
// tangent vectors; what counts is said at Tally (detail/counted.hpp). What observables do with a
// step is not in it.
double flops_per_step(const Study& study, std::size_t tangents);

}  // namespace gearsweep
