// Planetary stages of a gear unit.
#pragma once

#include "rexs/detail/lookup.hpp"
#include "rexs/gear_unit.hpp"

namespace gearsweep {

// Whether a coupling to the casing holds a shaft.
bool is_held(RexsLookup* lookup, const std::string& shaft);

// Fills in the planetary stages of a unit whose gears, shafts, bodies and stages are known.
void read_planetaries(RexsLookup* lookup, GearUnit* unit);

}  // namespace gearsweep
