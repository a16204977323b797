#include "rexs/detail/units.hpp"

#include <numbers>
#include <string>

namespace gearsweep {
namespace {

struct RexsUnit {
  RexsQuantity quantity;
  std::string_view name;  // without blanks
  double factor;
};

constexpr double kDegree = 180.0 / std::numbers::pi;
constexpr double kTurnPerRad = 0.5 / std::numbers::pi;

using enum RexsQuantity;
// Each quantity begins with the unit of REXS' own data model; the names that others write stand
// before it.
constexpr RexsUnit kRexsUnits[] = {{number, "none", 1.0},
                                   {number, "1", 1.0},
                                   {number, "-", 1.0},
                                   {number, "%", 0.01},
                                   {length, "mm", 1.0},
                                   {length, "m", 1e3},
                                   {length, "cm", 10.0},
                                   {length, "mum", 1e-3},
                                   {length, "um", 1e-3},
                                   {length, "\u00b5m", 1e-3},
                                   {length, "\u03bcm", 1e-3},
                                   {length, "in", 25.4},
                                   {length, "inch", 25.4},
                                   {length, "ft", 304.8},
                                   {angle, "deg", 1.0},
                                   {angle, "\u00b0", 1.0},
                                   {angle, "degree", 1.0},
                                   {angle, "rad", kDegree},
                                   {angle, "mrad", 1e-3 * kDegree},
                                   {mass, "kg", 1.0},
                                   {mass, "g", 1e-3},
                                   {mass, "mg", 1e-6},
                                   {mass, "t", 1e3},
                                   {mass, "lb", 0.45359237},
                                   {inertia, "kgm^2", 1e6},
                                   {inertia, "kgm2", 1e6},
                                   {inertia, "kgmm^2", 1.0},
                                   {inertia, "kgmm2", 1.0},
                                   {inertia, "kgcm^2", 100.0},
                                   {inertia, "gm^2", 1e3},
                                   {density, "kg/dm^3", 1.0},
                                   {density, "kg/m^3", 1e-3},
                                   {density, "g/cm^3", 1.0},
                                   {density, "kg/mm^3", 1e6},
                                   {density, "t/m^3", 1.0},
                                   {stiffness, "N/m", 1e-3},
                                   {stiffness, "N/mm", 1.0},
                                   {stiffness, "N/mum", 1e3},
                                   {stiffness, "N/um", 1e3},
                                   {stiffness, "N/\u00b5m", 1e3},
                                   {stiffness, "kN/mm", 1e3},
                                   {line_stiffness, "N/(mmmum)", 1.0},
                                   {line_stiffness, "N/(mmum)", 1.0},
                                   {line_stiffness, "N/mm/mum", 1.0},
                                   {line_stiffness, "N/mm/um", 1.0},
                                   {line_stiffness, "N/mm^2", 1e-3},
                                   {pressure, "N/mm^2", 1.0},
                                   {pressure, "MPa", 1.0},
                                   {pressure, "GPa", 1e3},
                                   {pressure, "Pa", 1e-6},
                                   {pressure, "N/m^2", 1e-6},
                                   {speed, "1/min", 1.0},
                                   {speed, "rpm", 1.0},
                                   {speed, "min^-1", 1.0},
                                   {speed, "U/min", 1.0},
                                   {speed, "1/s", 60.0},
                                   {speed, "Hz", 60.0},
                                   {speed, "rad/s", 60.0 * kTurnPerRad},
                                   {torque, "Nm", 1.0},
                                   {torque, "Nmm", 1e-3},
                                   {torque, "kNm", 1e3},
                                   {torque, "kNmm", 1.0},
                                   {power, "kW", 1.0},
                                   {power, "W", 1e-3},
                                   {power, "MW", 1e3},
                                   {power, "PS", 0.73549875},
                                   {power, "hp", 0.745699872},
                                   {share, "%", 0.01},
                                   {share, "none", 1.0},
                                   {share, "1", 1.0}};

}  // namespace

std::optional<double> rexs_unit(RexsQuantity quantity, std::string_view unit) {
  std::string name;
  for (const char letter : unit) {
    if (std::string_view(" \t\r\n*").find(letter) == std::string_view::npos) name += letter;
  }
  for (const RexsUnit& one : kRexsUnits) {
    if (one.quantity == quantity && (name.empty() || one.name == name)) return one.factor;
  }
  return std::nullopt;
}

std::vector<std::string_view> unit_names(RexsQuantity quantity) {
  std::vector<std::string_view> names;
  for (const RexsUnit& one : kRexsUnits) {
    if (one.quantity == quantity) names.push_back(one.name);
  }
  return names;
}

}  // namespace gearsweep
