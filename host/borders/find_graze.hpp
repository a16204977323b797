// The grazing borders near an orbit: where it only just touches a limit, or only just leaves it.
#pragma once

#include <vector>

#include "borders/crossing.hpp"
#include "borders/host_orbit_map.hpp"

namespace gearsweep {

// Where an orbit is looked at, and which way.
struct GrazeSeed {
  HeldOrbit orbit;
  PlanePlace
      way{};  // in shares of the window, of any length: the line that Newton's method stays on
  double near = 0.0;  // turns count whose level is at most this share of how far the level moves
};

// The grazes that Newton's method finds on the line, of the turns that are nearest to their limits.
// Empty where it finds none. All must outlive what is found.
std::vector<Crossing> find_grazes(const ParameterPlane& plane, HostOrbitMap* map,
                                  const GrazeSeed& seed);

}  // namespace gearsweep
