#include "rexs/detail/gear_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "rexs/detail/materials.hpp"

namespace gearsweep {
namespace {

using enum RexsQuantity;
using Components = std::vector<const RexsComponent*>;

constexpr double kRad = std::numbers::pi / 180.0;

// A change of the flanks, and its attribute that says by how much.
struct FlankChange {
  std::string_view type, amount;
};
constexpr std::array kFlankChanges = {
    FlankChange{"tip_relief", "tip_relief_depth"},
    FlankChange{"triangular_tip_relief", "triangular_tip_relief_depth"},
    FlankChange{"root_relief", "root_relief_depth"},
    FlankChange{"triangular_root_relief", "triangular_root_relief_depth"},
    FlankChange{"profile_crowning", "profile_crowning_at_tip"},
    FlankChange{"profile_slope", "profile_slope"},
    FlankChange{"profile_twist", ""},
    FlankChange{"profile_deviation", ""},
    FlankChange{"helix_crowning", "helix_crowning_amount_datum_face"},
    FlankChange{"helix_slope", "helix_slope"},
    FlankChange{"helix_deviation", ""},
    FlankChange{"end_relief_datum_face", ""},
    FlankChange{"end_relief_non_datum_face", ""},
    FlankChange{"topographical_modification", ""}};

class GearReader {
 public:
  GearReader(const RexsComponent& component, RexsLookup* lookup)
      : component_(component), lookup_(*lookup) {
    flanks_ = {&component};
    for (const char* side : {"left", "right"}) {
      for (const RexsComponent* one : lookup_.related(component, "flank", "gear", side)) {
        flanks_.push_back(one);
      }
    }
    for (const RexsComponent* one :
         lookup_.related(component, "reference", "origin", "referenced")) {
      if (one->type.ends_with("_tool")) tools_.push_back(one);
    }
    for (const RexsComponent* one :
         lookup_.related(component, "manufacturing_step", "workpiece", "tool")) {
      tools_.push_back(one);
    }
  }

  UnitGear run() {
    gear_.id = component_.id;
    gear_.name = component_.name.empty() ? component_.type + " " + component_.id : component_.name;
    read_teeth();
    read_module();
    read_pressure_angle();
    read_shift();
    read_rack();
    gear_.face_width = own("face_width", length);
    gear_.place = own("u_coordinate_on_shaft", length);
    read_tip();
    read_thickness();
    find_flank_changes();
    const RexsMaterial material = material_of(component_, &lookup_);
    gear_.modulus = material.modulus;
    gear_.poisson = material.poisson;
    return std::move(gear_);
  }

 private:
  std::optional<double> own(std::string_view name, RexsQuantity quantity) {
    return lookup_.number(component_, name, quantity);
  }
  std::optional<double> first_of(const Components& components, std::string_view name,
                                 RexsQuantity quantity) {
    for (const RexsComponent* one : components) {
      if (const auto found = lookup_.number(*one, name, quantity)) return found;
    }
    return std::nullopt;
  }

  void read_teeth() {
    gear_.is_ring = component_.type == "ring_gear";
    gear_.teeth = own("number_of_teeth", number);
    if (gear_.teeth && *gear_.teeth == 0.0) gear_.teeth.reset();
    if (gear_.teeth && *gear_.teeth < 0.0) {
      gear_.is_ring = true;
      gear_.teeth = -*gear_.teeth;
    }
  }

  void read_module() {
    gear_.helix = own("helix_angle_reference_diameter", angle);
    slope_ = std::cos(gear_.helix.value_or(0.0) * kRad);
    gear_.module = own("normal_module", length);
    if (const auto transverse = own("transverse_module", length); transverse && !gear_.module) {
      gear_.module = *transverse * slope_;
    }
    const auto diameter = own("reference_circle_diameter", length);
    if (!gear_.module && diameter && gear_.teeth) {
      gear_.module = std::fabs(*diameter) / *gear_.teeth * slope_;
    }
    if (!gear_.module) gear_.module = first_of(tools_, "normal_module", length);
  }

  void read_pressure_angle() {
    gear_.pressure_angle = first_of(flanks_, "normal_pressure_angle", angle);
    if (!gear_.pressure_angle) {
      gear_.pressure_angle = first_of(tools_, "normal_pressure_angle", angle);
    }
    for (const RexsComponent* flank : flanks_) {
      const auto other = lookup_.number(*flank, "normal_pressure_angle", angle);
      if (!other || std::fabs(*other - *gear_.pressure_angle) < 1e-6) continue;
      lookup_.note(
          fmt::format("{}: its flanks have two pressure angles, {:g} and {:g} degrees; a "
                      "study has the first for both",
                      lookup_.place(component_), *gear_.pressure_angle, *other));
    }
  }

  void read_shift() {
    gear_.shift = first_of(flanks_, "addendum_modification_coefficient", number);
    if (!gear_.shift && gear_.module) {
      gear_.shift = first_of(flanks_, "addendum_modification", length);
      if (gear_.shift) *gear_.shift /= *gear_.module;
    }
  }

  // The basic rack says addenda and the dedendum, which is the tool's addendum.
  void read_rack() {
    gear_.addendum = own("addendum_basic_profile", length);
    if (gear_.module && !gear_.addendum) {
      gear_.addendum = first_of(flanks_, "addendum_coefficient_basic_profile", number);
      if (gear_.addendum) *gear_.addendum *= *gear_.module;
    }
    gear_.dedendum = first_of(tools_, "addendum_reference_profile", length);
    if (gear_.module && !gear_.dedendum) {
      gear_.dedendum = first_of(tools_, "addendum_coefficient_reference_profile", number);
      if (gear_.dedendum) *gear_.dedendum *= *gear_.module;
    }
  }

  void read_tip() {
    auto tip = own("tip_diameter", length);
    if (!tip || !gear_.teeth || !gear_.module) return;
    *tip = std::fabs(*tip);
    const double reference = *gear_.module / slope_ * *gear_.teeth;
    const double shift = 2.0 * gear_.shift.value_or(0.0) * *gear_.module;
    const double beyond = gear_.is_ring ? reference - *tip : *tip - reference - shift;
    if (beyond > 0.0 && beyond < 4.0 * *gear_.module) {
      gear_.tip_diameter = tip;
      return;
    }
    lookup_.note(
        fmt::format("{}: its tip_diameter, {:g} mm, fits no gear of the reference diameter "
                    "{:.6g} mm; not taken",
                    lookup_.place(component_), *tip, reference));
  }

  // By how much its teeth are thinner than without play, along the normal of the flanks: the mean
  // of both deviations of the span, or of the chord in the normal or transverse section.
  void read_thickness() {
    const double alpha = gear_.pressure_angle.value_or(20.0) * kRad;
    const std::tuple<const char*, const char*, double> ways[] = {
        {"upper_backlash_allowance_referenced_to_span",
         "lower_backlash_allowance_referenced_to_span", 1.0},
        {"chordal_tooth_thickness_upper_deviation", "chordal_tooth_thickness_lower_deviation",
         std::cos(alpha)},
        {"chordal_transverse_tooth_thickness_upper_deviation",
         "chordal_transverse_tooth_thickness_lower_deviation", std::cos(alpha) * slope_}};
    for (const auto& [upper, lower, factor] : ways) {
      const auto a = own(upper, length), b = own(lower, length);
      if (!a || !b || gear_.thinned) continue;
      gear_.thinned = -0.5 * (*a + *b) * factor;
      gear_.thinned_by = upper;
    }
    if (gear_.thinned) return;
    for (const char* name : {"tooth_thickness_deviation_tolerance_series_din_3967_1978",
                             "upper_backlash_allowance_balls_or_pins"}) {
      const std::string text = lookup_.text(component_, name);
      if (!text.empty()) gear_.left_out.push_back(fmt::format("{} = {}", name, text));
    }
  }

  // Looks through what is related to the gear or its flanks.
  void find_flank_changes() {
    std::vector<std::string_view> seen;
    for (const RexsComponent* flank : flanks_) {
      for (const RexsRelation* relation : lookup_.relations_of(*flank)) {
        for (const RexsReference& reference : relation->references) {
          const RexsComponent* one = lookup_.component(reference.component);
          const auto change = std::ranges::find(kFlankChanges, one->type, &FlankChange::type);
          const bool is_new = std::ranges::find(seen, one->id) == seen.end();
          if (change == kFlankChanges.end() || !is_new) continue;
          seen.push_back(one->id);
          const RexsAttribute* amount = one->find(change->amount);
          const std::string label = amount == nullptr
                                        ? fmt::format("{} {}", one->type, one->id)
                                        : fmt::format("{} {} ({} = {} {})", one->type, one->id,
                                                      amount->id, amount->text, amount->unit);
          if (!takes_tip_relief(*one, label)) gear_.left_out.push_back(label);
        }
      }
    }
  }

  // One on the flank that comes first; the same one of the other flank is no other.
  bool takes_tip_relief(const RexsComponent& component, const std::string& label) {
    const std::string shape = lookup_.text(component, "shape_of_relief");
    const bool is_plain = shape.empty() || shape == "linear" || shape == "parabolic";
    const auto depth = lookup_.number(component, "tip_relief_depth", length);
    if (component.type != "tip_relief" || !is_plain || !depth || !(*depth > 0.0) ||
        lookup_.text(component, "specify_tangential_transition") == "true") {
      return false;
    }
    TipRelief relief = {*depth, lookup_.number(component, "tip_relief_datum_diameter", length),
                        lookup_.number(component, "tip_relief_datum_length", length),
                        shape == "parabolic", label};
    if (!relief.diameter && !relief.length) return false;
    if (!gear_.tip_relief) {
      gear_.tip_relief = relief;
      return true;
    }
    const TipRelief& first = *gear_.tip_relief;
    return first.depth == relief.depth && first.diameter == relief.diameter &&
           first.length == relief.length && first.is_parabolic == relief.is_parabolic;
  }

  const RexsComponent& component_;
  RexsLookup& lookup_;
  Components flanks_, tools_;
  double slope_ = 1.0;  // the cosine of the helix angle
  UnitGear gear_;
};

}  // namespace

UnitGear gear_of(const RexsComponent& component, RexsLookup* lookup) {
  return GearReader(component, lookup).run();
}

}  // namespace gearsweep
