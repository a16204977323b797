// Where a mirrored orbit breaks into a pair of others (mirror_symmetry.hpp).
#pragma once

#include <optional>

#include "borders/crossing.hpp"
#include "borders/host_orbit_map.hpp"

namespace gearsweep {

// Whether an orbit of a mirrored model is its own mirror image, half of its period later.
bool is_own_image(const ParameterPlane& plane, HostOrbitMap* map, const HeldOrbit& orbit);

// Whether a point of a mirrored model where the return map has a multiplier of +1 is a symmetry
// breaking, and no fold: the equations of a fold have no single solution there.
bool is_breaking(const ParameterPlane& plane, HostOrbitMap* map, const BorderEquations& equations,
                 const BorderPoint& point);

// The symmetry breaking of an orbit that is its own image, on the straight line through its place
// and another: at most `reach` times as far from the orbit as that. Nothing where Newton's method
// finds none, or another multiplier is outside the unit circle. All must outlive it.
std::optional<Crossing> find_breaking(const ParameterPlane& plane, HostOrbitMap* map,
                                      const HeldOrbit& orbit, const PlanePlace& there,
                                      double reach);

}  // namespace gearsweep
