// What a trajectory has in a map.
#pragma once

#include <cstddef>

#include "engine/engine.hpp"

namespace gearsweep {

// The number `part` of a quantity that is an output, of the trajectory of the plan that stands at
// `position` in a tile with this result. Not a number where it is over a parameter that is 0.
double map_value(const Plan& plan, const Quantity& quantity, std::size_t part,
                 std::size_t trajectory, const TileResult& result, std::size_t position);

}  // namespace gearsweep
