#include "gear/detail/contact_path.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace gearsweep {
namespace {

// What gives the tips.
const GearKey& tip_key(const GearDrawing& drawing) {
  return drawing.has(kTipDiameter) ? kTipDiameter : kAddendum;
}

// The thickness of a tooth at its tip, along the arc, in the transverse section.
double tip_thickness(const GearGeometry& geometry, std::size_t gear, double tip) {
  const double reference =
      geometry.reference(gear == 0 ? geometry.pinion_teeth : geometry.gear_teeth);
  const double base = gear == 0 ? geometry.pinion_base : geometry.gear_base;
  const double at_reference =
      geometry.module / std::cos(geometry.helix) *
      (0.5 * std::numbers::pi + 2.0 * geometry.shift[gear] * std::tan(geometry.normal_alpha));
  return 2.0 * tip *
         (at_reference / (2.0 * reference) + involute(std::acos(base / reference)) -
          involute(std::acos(base / tip)));
}

void refuse_pointed(const GearDrawing& drawing, const GearGeometry& geometry,
                    const std::vector<double>& tips) {
  for (std::size_t gear = 0; gear < tips.size(); ++gear) {
    const double thickness = tip_thickness(geometry, gear, tips[gear]);
    if (thickness > 0.0) continue;
    throw DrawingError(
        tip_key(drawing),
        fmt::format("the teeth of the {} come to a point before their tip circle of {:.6g} mm "
                    "in diameter; smaller tips are needed",
                    gear == 0 ? "pinion" : "gear", 2.0 * tips[gear]));
  }
}

// Contact begins on the gear's addendum circle and ends on the pinion's.
ContactPath path_from_tips(const GearGeometry& geometry, const std::vector<double>& tips) {
  const auto reach = [&](double tip, double base) {
    return (std::sqrt(tip * tip - base * base) - base * std::tan(geometry.alpha)) /
           geometry.base_pitch;
  };
  return {reach(tips[1], geometry.gear_base), reach(tips[0], geometry.pinion_base)};
}

// Radii of the tip circles.
std::vector<double> tips_of(const GearDrawing& drawing, const GearGeometry& geometry) {
  if (drawing.has(kTipDiameter) && drawing.has(kAddendum)) {
    throw DrawingError(kTipDiameter,
                       "tip_diameter_mm and addendum_mm both give the tips; keep one");
  }
  if (drawing.has(kTipDiameter)) {
    std::vector<double> tips = drawing.list(kTipDiameter);
    for (double& tip : tips) tip /= 2.0;
    return tips;
  }
  const std::vector<double> addenda =
      drawing.has(kAddendum) ? drawing.list(kAddendum) : std::vector<double>(2, geometry.module);
  return {
      geometry.reference(geometry.pinion_teeth) + addenda[0] + geometry.shift[0] * geometry.module,
      geometry.reference(geometry.gear_teeth) + addenda[1] + geometry.shift[1] * geometry.module};
}

// Involutes meet only between the two points where the line of action touches the base circles.
void refuse_interference(const GearDrawing& drawing, const GearGeometry& geometry,
                         const ContactPath& path) {
  const auto check = [&](double share, double base, const char* whose) {
    const double beyond = share * geometry.base_pitch - base * std::tan(geometry.alpha);
    if (beyond > 1e-9 * base) {
      const GearKey& origin = drawing.has(kContactRatio) ? kContactRatio : tip_key(drawing);
      throw DrawingError(
          origin,
          fmt::format("the path of contact reaches {:.3g} mm beyond the point where the line of "
                      "action touches the {}'s base circle (interference); a smaller "
                      "addendum_mm or contact_ratio is needed",
                      beyond, whose));
    }
  };
  check(path.approach, geometry.pinion_base, "pinion");
  check(path.recess, geometry.gear_base, "gear");
}

}  // namespace

ContactPath add_contact_path(const GearDrawing& drawing, const GearGeometry& geometry,
                             GearTarget* target) {
  const std::vector<double> tips = tips_of(drawing, geometry);
  const std::vector<double> addenda = {tips[0] - geometry.reference(geometry.pinion_teeth),
                                       tips[1] - geometry.reference(geometry.gear_teeth)};
  const GearKey& tips_from = drawing.has(kAddendum)       ? kAddendum
                             : drawing.has(kTipDiameter)  ? kTipDiameter
                             : drawing.has(kProfileShift) ? kProfileShift
                                                          : kCentreDistance;
  const ContactPath drawn = path_from_tips(geometry, tips);
  if (!(drawn.approach > 0.0 && drawn.recess > 0.0)) {
    throw DrawingError(
        tips_from,
        fmt::format("the addenda ({:.6g} and {:.6g} mm) do not reach over the pitch point "
                    "at centre_distance_mm = {:.6g}",
                    addenda[0], addenda[1], geometry.centre));
  }
  refuse_pointed(drawing, geometry, tips);
  const double from_geometry = drawn.contact_ratio();
  const std::optional<double> given = drawing.number(kContactRatio);
  const double eps = given.value_or(from_geometry);
  const double approach = drawn.approach / from_geometry;
  const std::string formula =
      fmt::format("addenda {:.6g} and {:.6g} mm: eps_a + eps_r = {:.6g} + {:.6g} = {:.6g}",
                  addenda[0], addenda[1], drawn.approach, drawn.recess, from_geometry);
  target->note("contact ratio {:.6g} {}", eps,
               given ? fmt::format("as given ({})", formula) : "from " + formula);
  target->add("eps", eps, given ? kContactRatio : tips_from, "{}",
              given ? "contact_ratio as given" : formula);
  target->add("approach", approach, tips_from, "eps_a/(eps_a + eps_r) = {:.6g} / {:.6g}",
              drawn.approach, from_geometry);
  const ContactPath used{approach * eps, (1.0 - approach) * eps};
  refuse_interference(drawing, geometry, used);
  return used;
}

}  // namespace gearsweep
