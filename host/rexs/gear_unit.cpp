#include "rexs/gear_unit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "rexs/detail/gear_sizes.hpp"
#include "rexs/detail/loads.hpp"
#include "rexs/detail/lookup.hpp"
#include "rexs/detail/planetary.hpp"
#include "rexs/detail/shaft_axes.hpp"
#include "rexs/detail/shaft_bodies.hpp"

namespace gearsweep {
namespace {

constexpr double kRigid = 1e9;  // N/mm; programs write more for what does not give

class UnitReader {
 public:
  explicit UnitReader(const RexsDocument& document) : document_(document), lookup_(document) {}

  GearUnit run() {
    out_.source = document_.source;
    out_.version = document_.version;
    out_.application = document_.application;
    for (const RexsComponent* one : lookup_.of_type("shaft")) {
      shafts_[one->id] = out_.shafts.size();
      UnitShaft& shaft = out_.shafts.emplace_back();
      shaft.id = one->id;
      shaft.name = one->name.empty() ? "shaft " + one->id : one->name;
      shaft.speed = lookup_.number(*one, "rotational_speed", RexsQuantity::speed);
    }
    for (const RexsComponent& one : document_.components) {
      if (is_gear(one)) read_gear(one);
      if (one.type.ends_with("_bearing") || one.type.starts_with("rolling_bearing_with")) {
        read_bearing(one);
      }
    }
    note_rigid_bearings();
    for (const RexsComponent& one : document_.components) {
      if (one.type.ends_with("_stage")) read_stage(one);
    }
    for (UnitShaft& shaft : out_.shafts) weigh(&shaft);
    read_planetaries(&lookup_, &out_);
    read_cases(&lookup_, &out_);
    note_what_is_left();
    out_.notes = document_.notices;
    for (std::string& note : lookup_.take_notes()) out_.notes.push_back(std::move(note));
    return std::move(out_);
  }

 private:
  static bool is_gear(const RexsComponent& one) {
    return one.type == "cylindrical_gear" || one.type == "ring_gear" || one.type == "bevel_gear" ||
           one.type == "worm_gear" || one.type == "worm_wheel";
  }

  void read_gear(const RexsComponent& component) {
    UnitGear gear = gear_of(component, &lookup_);
    gear.shaft = shaft_under(component, 0);
    gears_[component.id] = out_.gears.size();
    out_.gears.push_back(std::move(gear));
  }

  // The shaft that the component is a part of, be it by groups in between.
  std::optional<std::size_t> shaft_under(const RexsComponent& component, int depth) const {
    constexpr int kDeepestGroup = 8;
    if (depth > kDeepestGroup) return std::nullopt;
    for (const RexsComponent* owner : lookup_.related(component, "assembly", "part", "assembly")) {
      const auto found = shafts_.find(owner->id);
      if (found != shafts_.end()) return found->second;
      if (owner->type != "assembly_group") continue;
      if (const auto above = shaft_under(*owner, depth + 1)) return above;
    }
    return std::nullopt;
  }

  // One note for all of one stiffness.
  void note_rigid_bearings() {
    for (const auto& [stiffness, bearings] : rigid_) {
      const std::size_t more = bearings.size() - 1;
      lookup_.note(fmt::format(
          "{}{}: a radial_stiffness of {:g} N/mm stands for a rigid bearing; not taken",
          lookup_.place(*bearings.front()),
          more == 0 ? "" : fmt::format(" and {} bearing{} more", more, more == 1 ? "" : "s"),
          stiffness));
    }
  }

  void read_bearing(const RexsComponent& component) {
    UnitBearing bearing;
    bearing.id = component.id;
    bearing.name = component.name;
    bearing.kind = lookup_.text(component, "bearing_type");
    if (bearing.kind.empty()) bearing.kind = component.type;
    bearing.designation = lookup_.text(component, "catalogue_designation");
    for (const RexsRelation* relation : lookup_.relations_of(component)) {
      if (!is_of_sides(*relation)) continue;
      for (const RexsReference& reference : relation->references) {
        const auto shaft = shafts_.find(reference.component);
        if (shaft != shafts_.end()) bearing.shafts.push_back(shaft->second);
      }
    }
    const auto stiffness = lookup_.number(component, "radial_stiffness", RexsQuantity::stiffness);
    if (stiffness && *stiffness > 0.0 && *stiffness < kRigid) bearing.radial_stiffness = stiffness;
    if (stiffness && *stiffness >= kRigid) {
      rigid_[*stiffness].push_back(&component);
    }
    out_.bearings.push_back(std::move(bearing));
  }

  static StageKind kind_of(const RexsComponent& component) {
    if (component.type == "cylindrical_stage") return StageKind::external;
    if (component.type == "bevel_stage") return StageKind::bevel;
    return component.type == "worm_stage" ? StageKind::worm : StageKind::other;
  }

  void read_stage(const RexsComponent& component) {
    if (component.type == "planetary_stage") return;  // its meshes are stages of their own
    UnitStage stage;
    stage.id = component.id;
    stage.name = component.name.empty() ? component.type + " " + component.id : component.name;
    stage.kind = kind_of(component);
    for (const RexsComponent* owner : lookup_.related(component, "assembly", "part", "assembly")) {
      if (owner->type == "planetary_stage") stage.planetary = owner->id;
    }
    find_gears(component, &stage);
    using enum RexsQuantity;
    stage.centre_distance = lookup_.number(component, "center_distance", length);
    if (stage.centre_distance) *stage.centre_distance = std::fabs(*stage.centre_distance);
    stage.contact_ratio = lookup_.number(component, "radial_contact_ratio", number);
    stage.face_width = lookup_.number(component, "common_face_width", length);
    stage.shift_sum =
        lookup_.number(component, "sum_of_addendum_modification_coefficients", number);
    stage.backlash = mean_of(component, "minimum_normal_backlash", "maximum_normal_backlash");
    stage.transverse_backlash =
        mean_of(component, "minimum_transverse_backlash", "maximum_transverse_backlash");
    find_driver(component, &stage);
    stage.axes_apart = axes_apart(stage);
    stage.refusal = refusal_of(stage);
    out_.stages.push_back(std::move(stage));
  }

  // The mean of two lengths; nothing where one is missing.
  std::optional<double> mean_of(const RexsComponent& component, const char* least,
                                const char* most) {
    const auto a = lookup_.number(component, least, RexsQuantity::length);
    const auto b = lookup_.number(component, most, RexsQuantity::length);
    if (!a || !b) return std::nullopt;
    return 0.5 * (*a + *b);
  }

  // Data of each gear in a stage say which one drives.
  void find_driver(const RexsComponent& component, UnitStage* stage) {
    for (const RexsRelation* relation : lookup_.relations_of(component)) {
      if (relation->type != "stage_gear_data") continue;
      const RexsComponent* data = lookup_.component(relation->of_role("stage_gear_data"));
      const auto gear = gears_.find(relation->of_role("gear"));
      if (data == nullptr || gear == gears_.end()) continue;
      const bool drives = lookup_.text(*data, "is_driving_gear") == "true";
      for (std::size_t i = 0; i < 2; ++i) {
        if (drives && stage->gears[i] == gear->second) stage->driver = i;
      }
    }
  }

  std::optional<double> axes_apart(const UnitStage& stage) {
    const RexsComponent* shafts[2] = {};
    for (std::size_t i = 0; i < 2; ++i) {
      if (!stage.gears[i] || !out_.gears[*stage.gears[i]].shaft) return std::nullopt;
      shafts[i] = lookup_.component(out_.shafts[*out_.gears[*stage.gears[i]].shaft].id);
    }
    return distance_of_axes(*shafts[0], *shafts[1], &lookup_);
  }

  // gear_1 and gear_2 of a stage's relations; where roles are missing, gears in their order.
  void find_gears(const RexsComponent& component, UnitStage* stage) {
    std::vector<std::size_t> found;
    const auto add = [&](std::string_view id) {
      const auto gear = gears_.find(id);
      if (gear == gears_.end()) return;
      if (std::find(found.begin(), found.end(), gear->second) == found.end()) {
        found.push_back(gear->second);
      }
    };
    for (const char* role : {"gear_1", "gear_2"}) {
      for (const RexsComponent* one : lookup_.related(component, "stage", "stage", role)) {
        add(one->id);
      }
    }
    for (const RexsRelation* relation : lookup_.relations_of(component)) {
      for (const RexsReference& reference : relation->references) add(reference.component);
    }
    if (found.size() > 2) {
      lookup_.note(fmt::format("{}: {} gears are related to it; the first two are taken",
                               lookup_.place(component), found.size()));
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), 2); ++i) {
      stage->gears[i] = found[i];
      if (out_.gears[found[i]].is_ring && stage->kind == StageKind::external) {
        stage->kind = StageKind::internal;
      }
    }
  }

  std::string refusal_of(const UnitStage& stage) const {
    if (stage.kind == StageKind::internal) {
      return "a ring gear meshes inside; a drawing is of two gears with outer teeth";
    }
    if (stage.kind != StageKind::external) return "it has no cylindrical gears";
    if (!stage.gears[0] || !stage.gears[1]) {
      return "no relation of type 'stage' names its two gears";
    }
    const UnitGear& a = out_.gears[*stage.gears[0]];
    const UnitGear& b = out_.gears[*stage.gears[1]];
    std::vector<std::string> missing;
    for (const UnitGear* one : {&a, &b}) {
      if (!one->teeth) missing.push_back(fmt::format("{} has no number_of_teeth", one->name));
    }
    if (!a.module && !b.module) missing.emplace_back("its gears have no normal_module");
    if (!missing.empty()) return fmt::format("{}", fmt::join(missing, ", and "));
    if (a.module && b.module && std::fabs(*a.module - *b.module) > 1e-6 * *a.module) {
      return fmt::format("its gears have two modules, {:g} and {:g} mm", *a.module, *b.module);
    }
    const double helix = std::fabs(a.helix.value_or(0.0));
    if (a.helix && b.helix && std::fabs(helix - std::fabs(*b.helix)) > 1e-4) {
      return fmt::format("its gears have two helix angles, {:g} and {:g} degrees", *a.helix,
                         *b.helix);
    }
    return "";
  }

  void weigh(UnitShaft* shaft) {
    std::vector<std::pair<UnitGear*, const RexsComponent*>> gears;
    for (UnitGear& gear : out_.gears) {
      const RexsComponent* component = lookup_.component(gear.id);
      const bool is_there = gear.shaft && &out_.shafts[*gear.shaft] == shaft;
      if (is_there) gears.emplace_back(&gear, component);
    }
    weigh_shaft(*lookup_.component(shaft->id), gears, &lookup_, shaft);
  }

  // Kinds of components that nothing is read of.
  void note_what_is_left() {
    static const std::set<std::string_view> kRead = {"gear_unit",
                                                     "gear_casing",
                                                     "shaft",
                                                     "shaft_section",
                                                     "cylindrical_gear",
                                                     "ring_gear",
                                                     "cylindrical_gear_flank",
                                                     "cylindrical_stage_gear_data",
                                                     "stage_gear_data",
                                                     "flank_geometry",
                                                     "cylindrical_stage",
                                                     "planetary_stage",
                                                     "planet_carrier",
                                                     "side_plate",
                                                     "material",
                                                     "external_load",
                                                     "concept_bearing",
                                                     "rack_shaped_tool",
                                                     "cutter_wheel_tool",
                                                     "rolling_bearing_with_catalog_geometry",
                                                     "rolling_bearing_with_detailed_geometry",
                                                     "slide_bearing",
                                                     "additional_mass",
                                                     "coupling",
                                                     "switchable_coupling"};
    std::map<std::string_view, int> counts;
    for (const RexsComponent& one : document_.components) {
      if (!kRead.contains(one.type)) ++counts[one.type];
    }
    if (counts.empty()) return;
    std::string text;
    for (const auto& [type, count] : counts) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, type);
    }
    lookup_.note(fmt::format("{}: nothing is taken of {}", document_.source, text));
  }

  const RexsDocument& document_;
  RexsLookup lookup_;
  std::map<std::string_view, std::size_t> shafts_, gears_;
  std::map<double, std::vector<const RexsComponent*>>
      rigid_;  // bearings by a stiffness too high to be one
  GearUnit out_;
};

}  // namespace

GearUnit gear_unit_of(const RexsDocument& document) { return UnitReader(document).run(); }

}  // namespace gearsweep
