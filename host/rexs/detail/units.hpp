// Units of REXS.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace gearsweep {

// What a number measures, and the unit that it is turned into.
enum class RexsQuantity : std::uint8_t {
  number,          // 1
  length,          // mm
  angle,           // degree
  mass,            // kg
  inertia,         // kg mm^2
  density,         // kg/dm^3
  stiffness,       // N/mm
  line_stiffness,  // N/(mm um)
  pressure,        // N/mm^2
  speed,           // rpm
  torque,          // N m
  power,           // kW
  share            // 1
};

// What a number in `unit` is multiplied by. Without a unit it is in the one that REXS has for the
// quantity. Nothing for a unit that is not one of the quantity.
std::optional<double> rexs_unit(RexsQuantity quantity, std::string_view unit);

// All that rexs_unit() takes, without blanks: "mm", "m", "in".
std::vector<std::string_view> unit_names(RexsQuantity quantity);

}  // namespace gearsweep
