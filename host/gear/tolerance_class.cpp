#include "gear/tolerance_class.hpp"

#include <cmath>

namespace gearsweep {
namespace {

bool is_in_range(double value, double min, double max) { return value >= min && value <= max; }

// To 1 um above 10 um, to 0.5 um above 5 um, else to 0.1 um.
double rounded_tolerance(double um) {
  if (um > 10.0) return std::round(um);
  if (um >= 5.0) return std::round(um * 2.0) / 2.0;
  return std::round(um * 10.0) / 10.0;
}

}  // namespace

std::optional<FlankTolerances> flank_tolerances(const ToleranceClassInput& gear) {
  const double d = gear.reference_diameter;
  const double m = gear.normal_module;
  if (!is_in_range(d, 5.0, 15000.0) || !is_in_range(m, 0.5, 70.0) ||
      !is_in_range(gear.tolerance_class, 1.0, 11.0)) {
    return std::nullopt;
  }
  // Each class is sqrt(2) times as wide as the one before; the formulas are those of class 5.
  const double step = std::exp2(0.5 * (gear.tolerance_class - 5));
  const double total_pitch = (0.002 * d + 0.55 * std::sqrt(d) + 0.7 * m + 12.0) * step;
  const double slope = (0.4 * m + 0.001 * d + 4.0) * step;
  const double form = (0.55 * m + 5.0) * step;
  return FlankTolerances{.single_pitch = rounded_tolerance((0.001 * d + 0.4 * m + 5.0) * step),
                         .total_pitch = rounded_tolerance(total_pitch),
                         .profile_slope = rounded_tolerance(slope),
                         .profile_form = rounded_tolerance(form),
                         .profile_total = rounded_tolerance(std::hypot(slope, form)),
                         .runout = rounded_tolerance(0.9 * total_pitch)};
}

}  // namespace gearsweep
