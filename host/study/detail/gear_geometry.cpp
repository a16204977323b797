#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "study/detail/gear_parts.hpp"

namespace gearsweep {
namespace {

void read_teeth(GearReader& in, GearGeometry* out) {
  const std::vector<double> teeth = in.list(kTeeth, 2);
  if (!in.node(kTeeth).is_array() || std::floor(teeth[0]) != teeth[0] ||
      std::floor(teeth[1]) != teeth[1]) {
    fail_at(in.node(kTeeth), "teeth must be two whole numbers, [pinion, gear]");
  }
  out->pinion_teeth = teeth[0];
  out->gear_teeth = teeth[1];
}

// What gives the tips.
const GearKey& tip_key(const GearReader& in) {
  return in.has(kTipDiameter) ? kTipDiameter : kAddendum;
}

double involute(double angle) { return std::tan(angle) - angle; }

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
void refuse_overlap(const GearReader& in, const GearGeometry& geometry, double least) {
  const double rounding = 0.005 + 0.001 * geometry.module;  // mm
  if (geometry.centre >= least - rounding) return;
  fail_at(in.node(kCentreDistance),
          fmt::format("centre_distance_mm = {:.6g} is too small: with profile_shift = [{:g}, {:g}] "
                      "the teeth touch on both flanks at {:.6g} mm, and nearer they cannot be "
                      "assembled; teeth that are cut thinner have a smaller profile_shift",
                      geometry.centre, geometry.shift[0], geometry.shift[1], least));
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

void refuse_pointed(const GearReader& in, const GearGeometry& geometry,
                    const std::vector<double>& tips) {
  for (std::size_t gear = 0; gear < tips.size(); ++gear) {
    const double thickness = tip_thickness(geometry, gear, tips[gear]);
    if (thickness > 0.0) continue;
    fail_at(in.node(tip_key(in)),
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
std::vector<double> read_tips(GearReader& in, const GearGeometry& geometry) {
  if (in.has(kTipDiameter) && in.has(kAddendum)) {
    fail_at(in.node(kTipDiameter), "tip_diameter_mm and addendum_mm both give the tips; keep one");
  }
  if (in.has(kTipDiameter)) {
    std::vector<double> tips = in.list(kTipDiameter, 2);
    for (double& tip : tips) tip /= 2.0;
    return tips;
  }
  const std::vector<double> addenda =
      in.has(kAddendum) ? in.list(kAddendum, 2) : std::vector<double>(2, geometry.module);
  return {
      geometry.reference(geometry.pinion_teeth) + addenda[0] + geometry.shift[0] * geometry.module,
      geometry.reference(geometry.gear_teeth) + addenda[1] + geometry.shift[1] * geometry.module};
}

// Involutes meet only between the two points where the line of action touches the base circles.
void refuse_interference(const GearReader& in, const GearGeometry& geometry,
                         const ContactPath& path) {
  const auto check = [&](double share, double base, const char* whose) {
    const double beyond = share * geometry.base_pitch - base * std::tan(geometry.alpha);
    if (beyond > 1e-9 * base) {
      const GearKey& origin = in.has(kContactRatio) ? kContactRatio : tip_key(in);
      fail_at(
          in.node(origin),
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

GearGeometry read_geometry(GearReader& in) {
  GearGeometry out{};
  read_teeth(in, &out);
  out.module = in.required(kModule);
  out.helix = in.optional(kHelix).value_or(0.0) * std::numbers::pi / 180.0;
  out.shift = in.pair_or_zero(kProfileShift);
  const double normal_alpha = in.optional(kPressureAngle).value_or(20.0) * std::numbers::pi / 180.0;
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
  if (shifts != 0.0 && !in.has(kCentreDistance)) {
    if (!free) {
      fail_at(in.node(kProfileShift), "profile_shift brings the gears too near: no pressure angle");
    }
    out.alpha = *free;
    out.centre = (out.pinion_base + out.gear_base) / std::cos(out.alpha);
    return out;
  }
  out.centre = in.optional(kCentreDistance).value_or(standard);
  out.alpha = tool_alpha;
  if (std::fabs(out.centre - standard) > 1e-6 * standard) {
    const double touching = out.pinion_base + out.gear_base;
    if (out.centre <= touching) {
      fail_at(in.node(kCentreDistance),
              fmt::format("centre_distance_mm = {} is not greater than the sum of the base radii, "
                          "{:.6g} mm: there is no line of action (standard: {:.6g} mm)",
                          out.centre, touching, standard));
    }
    out.alpha = std::acos(touching / out.centre);
  }
  if (free) refuse_overlap(in, out, (out.pinion_base + out.gear_base) / std::cos(*free));
  return out;
}

ContactPath read_path(GearReader& in, const GearGeometry& geometry, GearParameters* parameters,
                      std::vector<std::string>* notes) {
  const std::vector<double> tips = read_tips(in, geometry);
  const std::vector<double> addenda = {tips[0] - geometry.reference(geometry.pinion_teeth),
                                       tips[1] - geometry.reference(geometry.gear_teeth)};
  const GearKey& drawing = in.has(kAddendum)       ? kAddendum
                           : in.has(kTipDiameter)  ? kTipDiameter
                           : in.has(kProfileShift) ? kProfileShift
                                                   : kCentreDistance;
  const ContactPath drawn = path_from_tips(geometry, tips);
  if (!(drawn.approach > 0.0 && drawn.recess > 0.0)) {
    fail_at(in.node(drawing),
            fmt::format("the addenda ({:.6g} and {:.6g} mm) do not reach over the pitch point "
                        "at centre_distance_mm = {:.6g}",
                        addenda[0], addenda[1], geometry.centre));
  }
  refuse_pointed(in, geometry, tips);
  const double from_geometry = drawn.contact_ratio();
  const std::optional<double> given = in.optional(kContactRatio);
  const double eps = given.value_or(from_geometry);
  const double approach = drawn.approach / from_geometry;
  const std::string formula =
      fmt::format("addenda {:.6g} and {:.6g} mm: eps_a + eps_r = {:.6g} + {:.6g} = {:.6g}",
                  addenda[0], addenda[1], drawn.approach, drawn.recess, from_geometry);
  notes->push_back(given ? fmt::format("contact ratio {:.6g} as given ({})", eps, formula)
                         : fmt::format("contact ratio {:.6g} from {}", eps, formula));
  parameters->add("eps", eps, given ? kContactRatio : drawing,
                  given ? "contact_ratio as given" : formula);
  parameters->add(
      "approach", approach, drawing,
      fmt::format("eps_a/(eps_a + eps_r) = {:.6g} / {:.6g}", drawn.approach, from_geometry));
  const ContactPath used{approach * eps, (1.0 - approach) * eps};
  refuse_interference(in, geometry, used);
  return used;
}

}  // namespace gearsweep
