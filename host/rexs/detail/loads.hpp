// Torques and speeds of the meshes of a gear unit.
#pragma once

#include "rexs/detail/lookup.hpp"
#include "rexs/gear_unit.hpp"

namespace gearsweep {

// Fills in the cases of a unit whose stages, gears and shafts are known.
void read_cases(RexsLookup* lookup, GearUnit* unit);

}  // namespace gearsweep
