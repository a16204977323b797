// The reference engine's 0-1 test for chaos, by its definition (G. A. Gottwald and I. Melbourne,
// SIAM J. Appl. Dyn. Syst. 8 (2009) 129-145): the walks themselves are computed, from all samples.
#pragma once

#include <memory>

#include "reference/detail/motion_range.hpp"
#include "reference/detail/observables.hpp"

namespace gearsweep {

// K of the first state at the end of each recorded period, with the angles, the largest lag and
// the centring of kernels/observables/zero_one.h. 0 when the samples stay at one value: when their
// standard deviation is at most `tolerance` times the motion's range. NaN with less than 100 of
// them.
std::unique_ptr<ReferenceObservable> make_zero_one(double tolerance, const StateKinds& kinds);

}  // namespace gearsweep
