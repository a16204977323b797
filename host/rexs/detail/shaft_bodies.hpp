// Masses of what is on a shaft.
#pragma once

#include <vector>

#include "rexs/detail/lookup.hpp"
#include "rexs/gear_unit.hpp"

namespace gearsweep {

struct BodyMass {
  double mass = 0.0, inertia = 0.0;  // kg, kg mm^2
};

// A full frustum has rho pi L/12 (D1^2 + D1 D2 + D2^2), and rho pi L/160 (D1^4 + D1^3 D2 + ... +
// D2^4) about its axis. Density in kg/dm^3.
BodyMass frustum(double length, double first, double last, double density);

// Fills in sections, material, mass, inertia and bodies of a shaft, and mass and inertia of the
// gears on it, which come with their components.
void weigh_shaft(const RexsComponent& component,
                 const std::vector<std::pair<UnitGear*, const RexsComponent*>>& gears,
                 RexsLookup* lookup, UnitShaft* shaft);

}  // namespace gearsweep
