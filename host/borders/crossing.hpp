// The bifurcation that lies between an orbit's place and a neighbouring pixel.
#pragma once

#include <memory>
#include <optional>

#include "borders/border.hpp"
#include "borders/held_orbits.hpp"
#include "borders/map_borders.hpp"

namespace gearsweep {

struct Crossing {
  std::unique_ptr<const BorderEquations> equations;
  BorderPoint point;
};

// Where the straight line from the orbit to a pixel meets a border of it at which it loses its
// stability, within 1.5 pixels of the middle of the edge. Nothing where none is found. All must
// outlive the crossing.
std::optional<Crossing> find_crossing(const ParameterPlane& plane, const PeriodPixels& pixels,
                                      OrbitMap* map, const HeldOrbit& orbit, std::size_t to,
                                      const BorderEdge& edge);

// The orbit on the way to another place, as near as it is found to where it ends or loses its
// stability.
HeldOrbit last_stable(const ParameterPlane& plane, OrbitMap* map, const HeldOrbit& start,
                      const PlanePlace& there);

}  // namespace gearsweep
