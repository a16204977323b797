// What a file says of one gear.
#pragma once

#include "rexs/detail/lookup.hpp"
#include "rexs/gear_unit.hpp"

namespace gearsweep {

// All but its shaft and its body. Sizes are those of the gear, its flanks and its tools, in this
// order.
UnitGear gear_of(const RexsComponent& component, RexsLookup* lookup);

}  // namespace gearsweep
