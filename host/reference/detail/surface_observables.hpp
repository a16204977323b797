// The reference engine's observables of surfaces.
#pragma once

#include <cstddef>
#include <memory>

#include "reference/detail/observables.hpp"

namespace gearsweep {

// Share of the time in which a motion stays at a surface, and how often it begins to
// (kernels/observables/sticking.h).
std::unique_ptr<ReferenceObservable> make_sticking();
// Impacts per period, and the rate at the hardest (kernels/observables/surface_impacts.h).
std::unique_ptr<ReferenceObservable> make_surface_impacts(std::size_t surface);

}  // namespace gearsweep
