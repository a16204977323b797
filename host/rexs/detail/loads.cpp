#include "rexs/detail/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "rexs/detail/planetary.hpp"

namespace gearsweep {
namespace {

constexpr double kPowerPerTorque = 30000.0 / std::numbers::pi;  // N m rpm of a kW

// Two shafts that turn together. ratio: speed of the second over that of the first.
struct Joint {
  std::size_t first, second;
  double ratio;
  std::optional<std::size_t> stage;
};

struct ShaftLoad {
  std::size_t shaft;
  const RexsComponent* component;
};

class CaseReader {
 public:
  CaseReader(RexsLookup* lookup, GearUnit* unit) : lookup_(*lookup), unit_(*unit) {
    join_stages();
    join_couplings();
    for (std::size_t i = 0; i < unit_.shafts.size(); ++i) {
      const RexsComponent* shaft = lookup_.component(unit_.shafts[i].id);
      for (const RexsComponent* part : lookup_.related(*shaft, "assembly", "assembly", "part")) {
        if (part->type == "external_load") loads_.push_back({i, part});
      }
    }
  }

  void run() {
    const auto& cases = lookup_.document().load_cases;
    for (const RexsLoadCase& one : cases) unit_.cases.push_back(read(&one));
    if (cases.empty()) unit_.cases.push_back(read(nullptr));
  }

 private:
  std::optional<std::size_t> shaft_of(const UnitStage& stage, std::size_t side) const {
    return stage.gears[side] ? unit_.gears[*stage.gears[side]].shaft : std::nullopt;
  }

  void join_stages() {
    for (std::size_t i = 0; i < unit_.stages.size(); ++i) {
      const UnitStage& stage = unit_.stages[i];
      const auto first = shaft_of(stage, 0), second = shaft_of(stage, 1);
      if (!first || !second || *first == *second || !stage.planetary.empty()) continue;
      const auto& a = unit_.gears[*stage.gears[0]].teeth;
      const auto& b = unit_.gears[*stage.gears[1]].teeth;
      if (!a || !b) continue;
      const double sense = stage.kind == StageKind::internal ? 1.0 : -1.0;
      joints_.push_back({*first, *second, sense * *a / *b, i});
    }
  }

  void join_couplings() {
    for (const RexsComponent& one : lookup_.document().components) {
      if (one.type != "coupling" && one.type != "switchable_coupling") continue;
      if (!lookup_.is_closed(one)) continue;
      std::vector<std::size_t> joined;
      for (std::size_t i = 0; i < unit_.shafts.size(); ++i) {
        const auto& relations = lookup_.relations_of(one);
        if (std::any_of(relations.begin(), relations.end(), [&](const RexsRelation* relation) {
              return is_of_sides(*relation) && relation->names(unit_.shafts[i].id);
            })) {
          joined.push_back(i);
        }
      }
      if (joined.size() == 2) joints_.push_back({joined[0], joined[1], 1.0, std::nullopt});
    }
  }

  // Signed speeds over that of `start`, of what is joined to it but by `without`.
  std::map<std::size_t, double> turning(std::size_t start, const Joint* without) const {
    std::map<std::size_t, double> speeds = {{start, 1.0}};
    std::vector<std::size_t> open = {start};
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      const auto reach = [&](std::size_t shaft, double speed) {
        if (speeds.emplace(shaft, speed).second) open.push_back(shaft);
      };
      for (const Joint& joint : joints_) {
        if (&joint == without) continue;
        if (joint.first == at) reach(joint.second, speeds[at] * joint.ratio);
        if (joint.second == at) reach(joint.first, speeds[at] / joint.ratio);
      }
    }
    return speeds;
  }

  // The component's number in this case, or for all cases.
  std::optional<double> number(const RexsLoadCase* from, const RexsComponent& component,
                               std::string_view name, RexsQuantity quantity) {
    if (from != nullptr) {
      for (const RexsComponent& one : from->components) {
        if (one.id != component.id) continue;
        if (const auto found = lookup_.number(one, name, quantity)) return found;
      }
    }
    return lookup_.number(component, name, quantity);
  }

  std::optional<double> speed_of(const RexsLoadCase* from, std::size_t shaft) {
    for (const auto& [other, ratio] : turning(shaft, nullptr)) {
      const auto speed = number(from, *lookup_.component(unit_.shafts[other].id),
                                "rotational_speed", RexsQuantity::speed);
      if (speed && *speed != 0.0) return std::fabs(*speed / ratio);
    }
    for (const auto& [other, ratio] : turning(shaft, nullptr)) {
      for (const UnitGear& gear : unit_.gears) {
        if (gear.shaft != other) continue;
        const auto speed =
            number(from, *lookup_.component(gear.id), "rotational_speed", RexsQuantity::speed);
        if (speed && *speed != 0.0) return std::fabs(*speed / ratio);
      }
    }
    return std::nullopt;
  }

  // What a program has computed for a gear of the mesh, on its first gear.
  std::optional<double> torque_on_gear(const RexsLoadCase* from, const UnitStage& stage) {
    for (const auto& gear : stage.gears) {
      if (!gear || !stage.gears[0] || !unit_.gears[*stage.gears[0]].teeth) continue;
      const UnitGear& own = unit_.gears[*gear];
      const auto torque = number(from, *lookup_.component(own.id), "torque_acting_on_shaft_u",
                                 RexsQuantity::torque);
      if (!torque || *torque == 0.0 || !own.teeth) continue;
      return std::fabs(*torque) * *unit_.gears[*stage.gears[0]].teeth / *own.teeth;
    }
    return std::nullopt;
  }

  // The torque that the loads of these shafts put on the one of speed 1; nothing where one of them
  // is not known, or there is none.
  std::optional<double> torque_of(const RexsLoadCase* from,
                                  const std::map<std::size_t, double>& speeds) {
    double sum = 0.0;
    for (const ShaftLoad& load : loads_) {
      const auto speed = speeds.find(load.shaft);
      if (speed == speeds.end()) continue;
      if (lookup_.text(*load.component, "transmits_torque") == "false") continue;
      auto torque = number(from, *load.component, "torque_around_u_axis", RexsQuantity::torque);
      const auto power = number(from, *load.component, "power", RexsQuantity::power);
      if (!torque && power) {
        if (const auto rpm = speed_of(from, load.shaft)) torque = kPowerPerTorque * *power / *rpm;
      }
      if (!torque) return std::nullopt;
      sum += *torque * speed->second;
    }
    if (sum == 0.0) return std::nullopt;
    return std::fabs(sum);
  }

  std::optional<double> torque_of_stage(const RexsLoadCase* from, std::size_t stage) {
    for (const Joint& joint : joints_) {
      if (joint.stage != stage) continue;
      const auto before = turning(joint.first, &joint);
      if (before.contains(joint.second)) return std::nullopt;  // the power splits
      const auto torque = torque_of(from, before);
      auto behind = torque_of(from, turning(joint.second, &joint));
      if (behind) *behind *= std::fabs(joint.ratio);
      if (!torque) return behind;
      constexpr double kLosses = 0.1;  // at most, of a stage that runs well
      if (behind && std::fabs(*behind / *torque - 1.0) > kLosses) {
        lookup_.note(
            fmt::format("{}: the loads on both sides of stage {} do not balance{}: {:.5g} and "
                        "{:.5g} N m on its first gear; the first is taken",
                        lookup_.document().source, stage + 1,
                        from == nullptr ? "" : " in load case " + from->id, *torque, *behind));
      }
      return torque;
    }
    return std::nullopt;
  }

  // The sun's torque is shared by as many meshes of its planetary stage as it has.
  std::optional<double> torque_of_planet(const RexsLoadCase* from, const UnitStage& stage) {
    const auto sun = sun_of(stage);
    if (!sun || !unit_.gears[*sun].shaft || stage.kind != StageKind::external) return std::nullopt;
    const auto torque = torque_of(from, turning(*unit_.gears[*sun].shaft, nullptr));
    if (!torque) return std::nullopt;
    const double share = *torque / static_cast<double>(meshes_of(*sun, stage));
    const UnitGear& first = unit_.gears[*stage.gears[0]];
    if (!first.teeth || !unit_.gears[*sun].teeth) return std::nullopt;
    return share * *first.teeth / *unit_.gears[*sun].teeth;
  }

  std::size_t meshes_of(std::size_t gear, const UnitStage& like) const {
    return static_cast<std::size_t>(
        std::count_if(unit_.stages.begin(), unit_.stages.end(), [&](const UnitStage& one) {
          return one.planetary == like.planetary && one.kind == StageKind::external &&
                 (one.gears[0] == gear || one.gears[1] == gear);
        }));
  }

  // The gear of more meshes; of a single planet nobody can tell.
  std::optional<std::size_t> sun_of(const UnitStage& stage) const {
    if (!stage.gears[0] || !stage.gears[1]) return std::nullopt;
    const std::size_t a = meshes_of(*stage.gears[0], stage), b = meshes_of(*stage.gears[1], stage);
    if (a == b) return std::nullopt;
    return a > b ? stage.gears[0] : stage.gears[1];
  }

  // Relative to the carrier, of a ring gear that is held by the casing:
  // n_sun z_ring/(z_sun + z_ring).
  std::optional<double> speed_of_planet(const RexsLoadCase* from, const UnitStage& stage) {
    const auto sun = sun_of(stage);
    if (!sun || !unit_.gears[*sun].shaft || !unit_.gears[*sun].teeth) return std::nullopt;
    const auto speed = speed_of(from, *unit_.gears[*sun].shaft);
    const auto ring = held_ring(stage.planetary);
    const UnitGear& first = unit_.gears[*stage.gears[0]];
    if (!speed || !ring || !first.teeth) return std::nullopt;
    const double z = *unit_.gears[*sun].teeth;
    return *speed * *ring / (z + *ring) * z / *first.teeth;
  }

  std::optional<double> held_ring(const std::string& planetary) {
    for (const UnitStage& one : unit_.stages) {
      if (one.planetary != planetary || one.kind != StageKind::internal) continue;
      for (const auto& gear : one.gears) {
        if (!gear || !unit_.gears[*gear].is_ring || !unit_.gears[*gear].shaft) continue;
        if (is_held(&lookup_, unit_.shafts[*unit_.gears[*gear].shaft].id))
          return unit_.gears[*gear].teeth;
      }
    }
    return std::nullopt;
  }

  UnitCase read(const RexsLoadCase* from) {
    UnitCase out;
    out.id = from == nullptr ? "" : from->id;
    for (const RexsComponent* one : lookup_.of_type("gear_unit")) {
      for (const char* name : {"load_duration_fraction", "operating_time_fraction"}) {
        if (!out.share) out.share = number(from, *one, name, RexsQuantity::share);
      }
    }
    for (std::size_t i = 0; i < unit_.stages.size(); ++i) {
      const UnitStage& stage = unit_.stages[i];
      const auto shaft = shaft_of(stage, 0);
      const bool is_planet = !stage.planetary.empty();
      out.torques.push_back(is_planet ? torque_of_planet(from, stage) : torque_of_stage(from, i));
      if (!out.torques.back() && !is_planet) out.torques.back() = torque_on_gear(from, stage);
      out.speeds.push_back(is_planet ? speed_of_planet(from, stage)
                           : shaft   ? speed_of(from, *shaft)
                                     : std::nullopt);
    }
    return out;
  }

  RexsLookup& lookup_;
  GearUnit& unit_;
  std::vector<Joint> joints_;
  std::vector<ShaftLoad> loads_;
};

}  // namespace

void read_cases(RexsLookup* lookup, GearUnit* unit) { CaseReader(lookup, unit).run(); }

}  // namespace gearsweep
