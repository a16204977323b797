// Masses of what is on a shaft.
#pragma once

#include <vector>

#include "rexs/detail/lookup.hpp"
#include "rexs/gear_unit.hpp"

namespace gearsweep {

// A piece of a shaft, a frustum of a cone with a bore that is one. In mm.
struct ShaftSection {
  double begin = 0.0, length = 0.0;
  double outer[2] = {0.0, 0.0}, inner[2] = {0.0, 0.0};  // diameters
};

struct BodyMass {
  double mass = 0.0, inertia = 0.0;  // kg, kg mm^2
};

// Of a full frustum: rho pi L/12 (D1^2 + D1 D2 + D2^2), and rho pi L/160 (D1^4 + D1^3 D2 + ... +
// D2^4) about its axis. Density in kg/dm^3.
BodyMass frustum(double length, double first, double last, double density);

// Fills in mass, inertia and bodies of a shaft. gears: those of the unit that are on it, with the
// components that they come from.
void weigh_shaft(const RexsComponent& component,
                 const std::vector<std::pair<const UnitGear*, const RexsComponent*>>& gears,
                 RexsLookup* lookup, UnitShaft* shaft);

}  // namespace gearsweep
