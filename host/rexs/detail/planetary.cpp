#include "rexs/detail/planetary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "rexs/detail/materials.hpp"
#include "rexs/detail/shaft_bodies.hpp"

namespace gearsweep {
namespace {

class PlanetaryReader {
 public:
  PlanetaryReader(const RexsComponent& component, RexsLookup* lookup, GearUnit* unit)
      : component_(component), lookup_(*lookup), unit_(*unit) {
    out_.id = component.id;
    out_.name = component.name.empty() ? component.type + " " + component.id : component.name;
  }

  UnitPlanetary run() {
    find_gears();
    if (out_.ring && unit_.gears[*out_.ring].shaft) {
      out_.is_ring_held = is_held(&lookup_, unit_.shafts[*unit_.gears[*out_.ring].shaft].id);
    }
    find_carrier();
    return std::move(out_);
  }

 private:
  // A planet meshes with the ring, and the sun with planets only.
  void find_gears() {
    const auto add = [](std::size_t gear, std::vector<std::size_t>* into) {
      if (std::ranges::find(*into, gear) == into->end()) into->push_back(gear);
    };
    std::vector<std::size_t> outer;
    for (const UnitStage& stage : unit_.stages) {
      if (stage.planetary != component_.id || !stage.gears[0] || !stage.gears[1]) continue;
      const std::size_t a = *stage.gears[0], b = *stage.gears[1];
      for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
        if (unit_.gears[one].is_ring) {
          out_.ring = one;
          add(other, &out_.planets);
        } else if (!unit_.gears[other].is_ring) {
          add(one, &outer);
        }
      }
    }
    for (const std::size_t gear : outer) {
      if (std::ranges::find(out_.planets, gear) == out_.planets.end()) out_.sun = gear;
    }
  }

  std::optional<std::size_t> shaft_of(const RexsComponent& component) const {
    const auto found = std::ranges::find(unit_.shafts, component.id, &UnitShaft::id);
    if (found == unit_.shafts.end()) return std::nullopt;
    return static_cast<std::size_t>(found - unit_.shafts.begin());
  }

  void add_body(const std::string& what, double mass, double inertia) {
    if (!(mass > 0.0)) return;
    out_.carrier_mass += mass;
    out_.carrier_inertia += inertia;
    out_.carrier_bodies.push_back(fmt::format("{} {:.4g} kg, {:.4g} kg mm^2", what, mass, inertia));
  }

  void add_shaft(std::size_t index, bool is_pin) {
    if (std::ranges::find(out_.carrier_shafts, index) != out_.carrier_shafts.end()) return;
    out_.carrier_shafts.push_back(index);
    const UnitShaft& shaft = unit_.shafts[index];
    const double radius = is_pin ? pin_radius() : 0.0;
    add_body(shaft.name, shaft.mass, shaft.inertia + shaft.mass * radius * radius);
  }

  double pin_radius() const {
    for (const UnitStage& stage : unit_.stages) {
      if (stage.planetary != component_.id) continue;
      if (stage.centre_distance) return *stage.centre_distance;
      if (stage.axes_apart) return *stage.axes_apart;
    }
    return 0.0;
  }

  void find_carrier() {
    for (const RexsComponent* pin :
         lookup_.related(component_, "planet_pin", "planetary_stage", "shaft")) {
      if (const auto shaft = shaft_of(*pin)) add_shaft(*shaft, true);
    }
    for (const RexsComponent* one :
         lookup_.related(component_, "planet_carrier_shaft", "planetary_stage", "shaft")) {
      if (const auto shaft = shaft_of(*one)) add_shaft(*shaft, false);
    }
    for (const RexsComponent* carrier :
         lookup_.related(component_, "assembly", "assembly", "part")) {
      if (carrier->type == "planet_carrier") add_carrier(*carrier);
    }
  }

  void add_carrier(const RexsComponent& carrier) {
    for (const RexsComponent* part : lookup_.related(carrier, "assembly", "assembly", "part")) {
      if (const auto shaft = shaft_of(*part)) add_shaft(*shaft, false);
      if (part->type == "side_plate") add_plate(*part);
    }
    const auto given = lookup_.number(carrier, "mass_of_component", RexsQuantity::mass);
    if (!given || !(*given > 0.0) || !(out_.carrier_mass > 0.0)) return;
    out_.carrier_inertia *= *given / out_.carrier_mass;
    out_.carrier_mass = *given;
    out_.carrier_bodies = {fmt::format("{:.4g} kg by mass_of_component", *given)};
  }

  void add_plate(const RexsComponent& plate) {
    constexpr double kSteelDensity = 7.85;  // kg/dm^3
    const auto size = [&](const char* name) {
      return lookup_.number(plate, name, RexsQuantity::length).value_or(0.0);
    };
    const double width = size("length"), outer = size("outer_diameter");
    const double inner = size("inner_diameter");
    if (!(width > 0.0 && outer > inner && inner >= 0.0)) return;
    const double density = material_of(plate, &lookup_).density.value_or(kSteelDensity);
    const BodyMass all = frustum(width, outer, outer, density);
    const BodyMass hole = frustum(width, inner, inner, density);
    add_body(plate.label(), all.mass - hole.mass, all.inertia - hole.inertia);
  }

  const RexsComponent& component_;
  RexsLookup& lookup_;
  GearUnit& unit_;
  UnitPlanetary out_;
};

}  // namespace

bool is_held(RexsLookup* lookup, const std::string& shaft) {
  const auto& relations = lookup->relations_of(*lookup->component(shaft));
  return std::any_of(relations.begin(), relations.end(), [&](const RexsRelation* relation) {
    if (!is_of_sides(*relation)) return false;
    bool has_coupling = false, has_casing = false;
    for (const RexsReference& reference : relation->references) {
      const RexsComponent& one = *lookup->component(reference.component);
      const bool couples = one.type == "coupling" || one.type == "switchable_coupling";
      has_coupling = has_coupling || (couples && lookup->is_closed(one));
      has_casing = has_casing || one.type == "gear_casing";
    }
    return has_coupling && has_casing;
  });
}

void read_planetaries(RexsLookup* lookup, GearUnit* unit) {
  for (const RexsComponent* one : lookup->of_type("planetary_stage")) {
    unit->planetaries.push_back(PlanetaryReader(*one, lookup, unit).run());
  }
}

}  // namespace gearsweep
