#include "gear/detail/geometry.hpp"

#include <fmt/format.h>

#include <optional>

namespace gearsweep {
namespace {

void set_teeth(const GearDrawing& drawing, GearGeometry* out) {
  const std::vector<double>& teeth = drawing.list(kTeeth);
  if (teeth.size() != 2 || std::floor(teeth[0]) != teeth[0] || std::floor(teeth[1]) != teeth[1]) {
    throw DrawingError(kTeeth, "teeth must be two whole numbers, [pinion, gear]");
  }
  out->pinion_teeth = teeth[0];
  out->gear_teeth = teeth[1];
}

// By Newton's method, from where it converges from above.
double angle_of_involute(double wanted) {
  double angle = std::fmin(std::cbrt(3.0 * wanted), 1.5);
  for (int i = 0; i < 50; ++i) {
    const double tangent = std::tan(angle);
    angle -= (tangent - angle - wanted) / (tangent * tangent);
  }
  return angle;
}

// The working pressure angle at which the gears stand without play of the tool's profile:
// inv(alpha_w) = inv(alpha_t) + 2 tan(alpha_n) x/z. Nothing where there is none.
std::optional<double> angle_without_play(const GearGeometry& geometry, double normal_alpha,
                                         double tool_alpha) {
  const double shifts = geometry.shift[0] + geometry.shift[1];
  if (shifts == 0.0) return tool_alpha;
  const double teeth = geometry.pinion_teeth + geometry.gear_teeth;
  const double wanted = involute(tool_alpha) + 2.0 * std::tan(normal_alpha) * shifts / teeth;
  if (wanted <= 0.0) return std::nullopt;
  return angle_of_involute(wanted);
}

// Nearer than without play, teeth of the full thickness would lie in one another. Drawings round
// centre distances to 0.01 mm and shift coefficients to three digits.
void refuse_overlap(const GearGeometry& geometry, double least) {
  const double rounding = 0.005 + 0.001 * geometry.module;  // mm
  if (geometry.centre >= least - rounding) return;
  throw DrawingError(
      kCentreDistance,
      fmt::format("centre_distance_mm = {:.6g} is too small: with profile_shift = [{:g}, {:g}] "
                  "the teeth touch on both flanks at {:.6g} mm, and nearer they cannot be "
                  "assembled; teeth that are cut thinner have a smaller profile_shift",
                  geometry.centre, geometry.shift[0], geometry.shift[1], least));
}

}  // namespace

GearGeometry geometry_of(const GearDrawing& drawing) {
  GearGeometry out{};
  set_teeth(drawing, &out);
  out.module = drawing.required(kModule);
  out.helix = drawing.number(kHelix).value_or(0.0) * std::numbers::pi / 180.0;
  out.shift = drawing.pair_or_zero(kProfileShift);
  const double normal_alpha =
      drawing.number(kPressureAngle).value_or(20.0) * std::numbers::pi / 180.0;
  const double tool_alpha =
      out.helix == 0.0 ? normal_alpha : std::atan(std::tan(normal_alpha) / std::cos(out.helix));
  out.pinion_base = out.reference(out.pinion_teeth) * std::cos(tool_alpha);
  out.gear_base = out.reference(out.gear_teeth) * std::cos(tool_alpha);
  out.base_pitch = 2.0 * std::numbers::pi * out.pinion_base / out.pinion_teeth;
  const double teeth = out.pinion_teeth + out.gear_teeth;
  const double standard = out.reference(teeth);
  const double shifts = out.shift[0] + out.shift[1];
  out.normal_alpha = normal_alpha;
  const std::optional<double> free = angle_without_play(out, normal_alpha, tool_alpha);
  if (shifts != 0.0 && !drawing.has(kCentreDistance)) {
    if (!free) {
      throw DrawingError(kProfileShift,
                         "profile_shift brings the gears too near: no pressure angle");
    }
    out.alpha = *free;
    out.centre = (out.pinion_base + out.gear_base) / std::cos(out.alpha);
    return out;
  }
  out.centre = drawing.number(kCentreDistance).value_or(standard);
  out.alpha = tool_alpha;
  if (std::fabs(out.centre - standard) > 1e-6 * standard) {
    const double touching = out.pinion_base + out.gear_base;
    if (out.centre <= touching) {
      throw DrawingError(
          kCentreDistance,
          fmt::format("centre_distance_mm = {} is not greater than the sum of the base radii, "
                      "{:.6g} mm: there is no line of action (standard: {:.6g} mm)",
                      out.centre, touching, standard));
    }
    out.alpha = std::acos(touching / out.centre);
  }
  if (free) refuse_overlap(out, (out.pinion_base + out.gear_base) / std::cos(*free));
  return out;
}

}  // namespace gearsweep
