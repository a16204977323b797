#include "rexs/detail/planetary_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gear/drawing_keys.hpp"
#include "gear/ring_mesh.hpp"
#include "rexs/stage_choice.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kPlanets = 3;  // of the model

class PlanetarySet {
 public:
  PlanetarySet(const GearUnit& unit, const std::string& load_case) : unit_(unit) {
    find();
    case_ = chosen_case(unit, mesh_, load_case);
  }

  UnitDrawing run() {
    const UnitGear &sun = unit_.gears[*set_->sun], &ring = unit_.gears[*set_->ring];
    out_.model = "planetary";
    out_.summary = fmt::format("sun {:g}, three planets {:g}, ring {:g} teeth", *sun.teeth,
                               *planet().teeth, *ring.teeth);
    StageDrawing drawing =
        stage_drawing(unit_, mesh_, case_, {set_->sun, static_cast<int>(kPlanets)});
    add("z_ring", *ring.teeth, "teeth of the ring; from the file");
    add_ring_mesh(drawing);
    add_carrier();
    add_bearings();
    out_.about =
        fmt::format(
            "The whole unit: {}. Speeds are those of the sun relative to the carrier, the torque "
            "is that on the sun.\n",
            set_->name) +
        text_of(drawing.cases);
    out_.drawings.emplace_back("sun", std::move(drawing));
    out_.notes.emplace_back(
        "the ring is rigid here; its mesh is as stiff as that of the sun (k0_ring), and free of "
        "errors (e0_ring)");
    return std::move(out_);
  }

 private:
  const UnitGear& planet() const { return unit_.gears[set_->planets.front()]; }

  void add(const std::string& name, double value, const std::string& origin) {
    out_.parameters.push_back({name, fmt::format("{:.10g}", value), origin});
  }

  std::size_t meshes_with(std::size_t gear) const {
    return static_cast<std::size_t>(std::ranges::count_if(unit_.stages, [&](const UnitStage& one) {
      return one.gears[0] == gear || one.gears[1] == gear;
    }));
  }

  static bool are_alike(const UnitGear& a, const UnitGear& b) {
    return a.teeth == b.teeth && a.module == b.module && a.shift == b.shift &&
           a.face_width == b.face_width && a.helix == b.helix;
  }

  void find() {
    const auto is_other = [&](const UnitStage& stage) {
      return stage.planetary != unit_.planetaries.front().id;
    };
    if (unit_.planetaries.size() > 1 || std::ranges::any_of(unit_.stages, is_other)) {
      throw NoArrangement(
          "it has a planetary stage and others beside it, and the model planetary "
          "is of one alone");
    }
    set_ = &unit_.planetaries.front();
    if (!set_->sun || !set_->ring) {
      throw NoArrangement(fmt::format("{} has no {}", set_->name, set_->sun ? "ring gear" : "sun"));
    }
    if (set_->planets.size() != kPlanets || meshes_with(*set_->sun) != kPlanets ||
        meshes_with(*set_->ring) != kPlanets) {
      throw NoArrangement(
          fmt::format("it has {} planets, and the model planetary has three, each "
                      "in a mesh with the sun and one with the ring",
                      set_->planets.size()));
    }
    for (const std::size_t other : set_->planets) {
      if (are_alike(planet(), unit_.gears[other])) continue;
      throw NoArrangement(fmt::format("its planets {} and {} are not alike", planet().name,
                                      unit_.gears[other].name));
    }
    for (const std::size_t gear : {*set_->sun, *set_->ring, set_->planets.front()}) {
      if (!unit_.gears[gear].teeth) {
        throw NoArrangement(fmt::format("{} has no number_of_teeth", unit_.gears[gear].name));
      }
    }
    if (!set_->is_ring_held && unit_.gears[*set_->ring].shaft) {
      throw NoArrangement(
          "no coupling to the casing holds its ring, and in the model planetary the "
          "ring is held");
    }
    find_mesh();
  }

  // The first mesh of the sun.
  void find_mesh() {
    for (std::size_t i = unit_.stages.size(); i-- > 0;) {
      const UnitStage& stage = unit_.stages[i];
      if (stage.gears[0] == set_->sun || stage.gears[1] == set_->sun) mesh_ = i;
    }
    if (!unit_.stages[mesh_].refusal.empty()) {
      throw NoArrangement(unit_.stages[mesh_].refusal);
    }
  }

  // The contact ratio of planet and ring, and the share before the pitch point, by their involutes:
  // contact begins at the ring's tips. Tips without a diameter are a module from the reference
  // circle, with the shift, which makes a ring's circle smaller where it is positive (DIN 3960).
  void add_ring_mesh(const StageDrawing& drawing) {
    const UnitGear &own = planet(), &ring = unit_.gears[*set_->ring];
    constexpr double kDegree = std::numbers::pi / 180.0;
    const double helix = std::fabs(own.helix.value_or(0.0)) * kDegree;
    const double module = drawing.module;
    const double radius = 0.5 * module / std::cos(helix);  // of one tooth
    const double alpha =
        std::atan(std::tan(own.pressure_angle.value_or(20.0) * kDegree) / std::cos(helix));
    const auto centre = drawing.keys.find(kCentreDistance.name);
    const UnitGear& sun = unit_.gears[*set_->sun];
    const double apart = centre != drawing.keys.end() ? std::stod(centre->second.value)
                                                      : radius * (*sun.teeth + *own.teeth);
    const double tip = own.tip_diameter
                           ? 0.5 * *own.tip_diameter
                           : radius * *own.teeth + module * (1.0 + own.shift.value_or(0.0));
    const double ring_tip = ring.tip_diameter
                                ? 0.5 * *ring.tip_diameter
                                : radius * *ring.teeth - module * (1.0 + ring.shift.value_or(0.0));
    const RingContact contact =
        ring_contact({*own.teeth, *ring.teeth, radius, alpha, apart, tip, ring_tip});
    if (!contact.is_usable()) {
      out_.notes.push_back(fmt::format(
          "the tips of {} and {} give the contact ratio {:.4g}, which is not taken: eps_ring "
          "is that of the model",
          own.name, ring.name, contact.ratio()));
      return;
    }
    if (contact.interferes()) {
      out_.notes.push_back(fmt::format(
          "the tips of {} reach beyond the point where the line of action touches the base circle "
          "of {} (interference): eps_ring counts all of that path",
          ring.name, own.name));
    }
    add("eps_ring", contact.ratio(), "contact ratio of planet and ring; computed from their tips");
    add("approach_ring", contact.approach(), "its share before the pitch point; computed");
  }

  void add_carrier() {
    const double apart =
        unit_.stages[mesh_].centre_distance.value_or(unit_.stages[mesh_].axes_apart.value_or(0.0));
    double mass = set_->carrier_mass, inertia = set_->carrier_inertia;
    std::string origin = "ESTIMATE: of " + fmt::format("{}", fmt::join(set_->carrier_bodies, ", "));
    if (!(mass > 0.0 && inertia > 0.0)) {
      const UnitGear& own = planet();
      const double one = own.shaft ? unit_.shafts[*own.shaft].mass : 0.0;
      if (!(one > 0.0 && apart > 0.0)) {
        out_.notes.emplace_back(
            "the file has no body of the carrier: mass_carrier and inertia_carrier are those of "
            "the "
            "model, of another gear set");
        return;
      }
      mass = static_cast<double>(kPlanets) * one;
      inertia = mass * apart * apart;
      origin = "ESTIMATE: as heavy as the planets, on their circle, for the file has no body of it";
    }
    add("mass_carrier", mass, "mass of the carrier with its pins in kg; " + origin);
    add("inertia_carrier", 1e-6 * inertia,
        "its moment of inertia in kg m^2; ESTIMATE: of the same bodies");
  }

  // The sum of the bearings that stand on one of the shafts, in N/m; 0 where there is none.
  void add_bearing(const std::string& name, const std::string& what,
                   const std::vector<std::size_t>& shafts) {
    constexpr double kUsual = 2e8;  // N/m, of two ball bearings
    double sum = 0.0;
    bool is_known = true, is_there = false;
    for (const UnitBearing& one : unit_.bearings) {
      const bool is_here = std::ranges::any_of(shafts, [&](std::size_t shaft) {
        return std::ranges::find(one.shafts, shaft) != one.shafts.end();
      });
      // A pin's bearing is none of the carrier.
      const bool is_of_planet = one.shafts.size() > 1;
      if (!is_here || is_of_planet != (name == "k_pin")) continue;
      is_there = true;
      is_known = is_known && one.radial_stiffness.has_value();
      sum += 1e3 * one.radial_stiffness.value_or(0.0);
    }
    if (is_there && is_known && sum > 0.0) {
      add(name, sum, what + " in N/m; from the file: the sum of radial_stiffness");
    } else if (!is_there && name == "k_sun") {
      add(name, 0.0, what + " in N/m; from the file: the sun has none, and floats");
    } else {
      add(name, kUsual, what + " in N/m; ESTIMATE: that of two ball bearings");
    }
  }

  void add_bearings() {
    const UnitGear& sun = unit_.gears[*set_->sun];
    std::vector<std::size_t> of_sun, of_planet;
    if (sun.shaft) of_sun.push_back(*sun.shaft);
    if (planet().shaft) of_planet.push_back(*planet().shaft);
    add_bearing("k_sun", "bearings of the sun", of_sun);
    add_bearing("k_pin", "pin and bearings of a planet", of_planet);
    add_bearing("k_carrier", "bearings of the carrier", set_->carrier_shafts);
    add("turn_carrier", 1e5,
        "output shaft to what it drives in N m/rad; ESTIMATE: far softer than the teeth");
  }

  const GearUnit& unit_;
  const UnitPlanetary* set_ = nullptr;
  std::size_t mesh_ = 0, case_ = 0;
  UnitDrawing out_;
};

}  // namespace

UnitDrawing planetary_drawing(const GearUnit& unit, const std::string& load_case) {
  return PlanetarySet(unit, load_case).run();
}

}  // namespace gearsweep
