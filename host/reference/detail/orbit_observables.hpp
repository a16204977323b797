// The reference engine's observables of the sections, the states at phase 0 of each period: how
// they recur, and what kind of motion that makes, by the definitions in kernels/observables/
// (period.h, settled.h, motion.h, section.h).
#pragma once

#include <memory>

#include "reference/detail/motion_range.hpp"
#include "reference/detail/observables.hpp"

namespace gearsweep {

// Two sections are the same when no component differs by more than `tolerance` times the range of
// the motion (motion_range.hpp).

// The period of the motion in forcing periods, 0 when there is none.
std::unique_ptr<ReferenceObservable> make_period(double tolerance, const StateKinds& kinds);
// Forcing periods until the motion stayed periodic, NaN when it did not.
std::unique_ptr<ReferenceObservable> make_settled(double tolerance, const StateKinds& kinds);
// The kind of motion, a value of motion_class; needs a tangent vector.
std::unique_ptr<ReferenceObservable> make_motion(double tolerance, const StateKinds& kinds);
// Smallest value of each state, then largest value of each.
std::unique_ptr<ReferenceObservable> make_section();

}  // namespace gearsweep
