// The reference engine's moments of the states (kernels/observables/state_moments.h).
#pragma once

#include <memory>

#include "reference/detail/observables.hpp"

namespace gearsweep {

// Mean of each state, then standard deviations, then the standard errors of both.
std::unique_ptr<ReferenceObservable> make_state_moments(const Model& model);

}  // namespace gearsweep
