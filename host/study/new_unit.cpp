#include "study/new_unit.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "gear/drawing_keys.hpp"
#include "gear/ring_mesh.hpp"
#include "gear/steel.hpp"
#include "study/detail/gear_lines.hpp"
#include "study/gear_text.hpp"

namespace gearsweep {
namespace {

constexpr const char* kEstimates =
    "ESTIMATE marks what nobody gave: put your own numbers there. Keys behind a # are others that "
    "a drawing may have.\n";

// The drawing of gears that nothing is known of but what was given. mesh: whose numbers.
GearText drawing_of(const NewUnit& unit, std::array<int, 2> teeth, std::size_t mesh) {
  GearText text;
  text.teeth = teeth;
  text.module_mm = unit.module_mm[mesh];
  text.face_width_mm = unit.face_width_mm[mesh];
  text.keys[kTeeth.name] = {fmt::format("[{}, {}]", teeth[0], teeth[1]), ""};
  text.keys[kModule.name] = {fmt::format("{}", unit.module_mm[mesh]), ""};
  const auto set = [&](const GearKey& key, const std::optional<double>& value) {
    if (value) text.keys[key.name] = {fmt::format("{}", *value), ""};
  };
  set(kFaceWidth, unit.face_width_mm[mesh]);
  set(kHelix, unit.helix_angle_deg[mesh]);
  return text;
}

void set_torque(const NewUnit& unit, GearText* first) {
  if (unit.torque_N_m) first->keys[kTorque.name] = {fmt::format("{}", *unit.torque_N_m), ""};
}

UnitText idler_text(const NewUnit& unit) {
  const std::vector<int>& teeth = unit.teeth;
  UnitText text;
  text.model = "idler";
  text.title = fmt::format("Three gears in a row {}/{}/{}, module {} mm", teeth[0], teeth[1],
                           teeth[2], unit.module_mm[0]);
  text.about = fmt::format(
      "Three gears in a row: a driver of {} teeth, an idler of {}, a last gear of {}, module {} "
      "mm.\nThe torque on the driver is the load of both meshes. The idler is in both drawings: "
      "what you give of it in one has to be the same in the other.\n",
      teeth[0], teeth[1], teeth[2], unit.module_mm[0]);
  text.parameters = {
      {"angle", "180",
       "angle at the idler from the driver to the last gear, in degrees, in the sense in which the "
       "idler turns; ESTIMATE: the three axes lie in a line"}};
  text.drawings = {{"first", drawing_of(unit, {teeth[0], teeth[1]}, 0)},
                   {"second", drawing_of(unit, {teeth[1], teeth[2]}, 0)}};
  return text;
}

UnitText two_stages_text(const NewUnit& unit) {
  const std::vector<int>& teeth = unit.teeth;
  UnitText text;
  text.model = "two_stages";
  text.title = fmt::format("Two stages {}/{} and {}/{}, module {} and {} mm", teeth[0], teeth[1],
                           teeth[2], teeth[3], unit.module_mm[0], unit.module_mm[1]);
  text.about = fmt::format(
      "Two stages, {}/{} teeth with a module of {} mm and {}/{} teeth with one of {} mm. The gear "
      "of {} teeth and the pinion of {} are on one shaft.\nThe torque of [gear.first] is the load "
      "of both meshes. The inertia of a gear includes what turns with it, such as half of the "
      "middle shaft.\n",
      teeth[0], teeth[1], unit.module_mm[0], teeth[2], teeth[3], unit.module_mm[1], teeth[1],
      teeth[2]);
  text.options = {{"shaft", "rigid"}};
  text.parameters = {
      {"k_shaft", "1e6",
       "with shaft = \"elastic\": torsional stiffness of the middle shaft between its gears, in N "
       "m/rad",
       true},
      {"shift", "0",
       "by how much of its mesh period the second mesh is ahead, from 0 to 1; ESTIMATE: how the "
       "teeth of both gears of the middle shaft stand to each other is on few drawings"}};
  text.drawings = {{"first", drawing_of(unit, {teeth[0], teeth[1]}, 0)},
                   {"second", drawing_of(unit, {teeth[2], teeth[3]}, 1)}};
  return text;
}

// What the study of a planetary set has beside the drawing of sun and planet.
class PlanetarySetText {
 public:
  explicit PlanetarySetText(const NewUnit& unit) : unit_(unit) {
    const double helix = unit.helix_angle_deg[0].value_or(0.0) * std::numbers::pi / 180.0;
    constexpr double kTool = 20.0 * std::numbers::pi / 180.0;
    reference_ = 0.5 * unit.module_mm[0] / std::cos(helix);
    alpha_ = std::atan(std::tan(kTool) / std::cos(helix));
    width_ = unit.face_width_mm[0].value_or(kEstimatedWidth * unit.module_mm[0]);
  }

  UnitText run() {
    const int sun = unit_.teeth[0], planet = unit_.teeth[1], ring = unit_.teeth[2];
    text_.model = "planetary";
    text_.title =
        fmt::format("Planetary set {}/{}/{}, module {} mm", sun, planet, ring, unit_.module_mm[0]);
    text_.about = fmt::format(
        "A planetary set: a sun of {} teeth that drives, three planets of {}, a ring of {} that "
        "the housing holds, module {} mm. The carrier is the output.\nThe torque is that on the "
        "sun, which the planets share. Speeds are those of the sun relative to the carrier.\n",
        sun, planet, ring, unit_.module_mm[0]);
    GearText drawing = drawing_of(unit_, {sun, planet}, 0);
    if (!unit_.torque_N_m) {
      const double radius = 0.5 * unit_.module_mm[0] * sun;
      drawing.keys[kTorque.name] = {
          fmt::format("{}", rounded(3.0 * kEstimatedLoad * width_ * radius * 1e-3)),
          fmt::format("ESTIMATE: {:g} N for each mm of the face width at each of three planets",
                      kEstimatedLoad)};
    }
    text_.drawings.emplace_back("sun", std::move(drawing));
    add("z_ring", fmt::format("{}", ring), "teeth of the ring");
    add_ring_mesh();
    add_carrier();
    add_bearings();
    return std::move(text_);
  }

 private:
  void add(const char* name, std::string value, std::string comment, bool is_default = false) {
    text_.parameters.push_back({name, std::move(value), std::move(comment), is_default});
  }

  double centre() const { return reference_ * (unit_.teeth[0] + unit_.teeth[1]); }

  void add_ring_mesh() {
    const double module = unit_.module_mm[0];
    const double planet = unit_.teeth[1], ring = unit_.teeth[2];
    RingContact contact = ring_contact({planet, ring, reference_, alpha_, centre(),
                                        reference_ * planet + module, reference_ * ring - module});
    std::string tips = "tips one module from the reference circles";
    if (contact.interferes()) {
      contact.before = contact.most_before;
      tips += ", the ring's cut back to where the involutes of the planet begin";
    }
    if (contact.is_usable()) {
      add("eps_ring", fmt::format("{:.6g}", contact.ratio()),
          "contact ratio of planet and ring; ESTIMATE: " + tips);
      add("approach_ring", fmt::format("{:.6g}", contact.approach()),
          "its share before the pitch point; ESTIMATE: of the same tips");
    } else {
      add("eps_ring", "1.8",
          "contact ratio of planet and ring; ESTIMATE: tips one module from the reference circles "
          "give none, so these teeth need a profile shift or other tips");
    }
    add("e0_ring", "\"e0_sun\"",
        "transmission error of planet and ring in half backlashes; ESTIMATE: that of sun and "
        "planet");
  }

  void add_carrier() {
    const double radius = reference_ * unit_.teeth[1];
    const double mass = 3.0 * kSteel * std::numbers::pi * radius * radius * width_;  // kg
    add("mass_carrier", fmt::format("{:.4g}", mass),
        "mass of the carrier with its pins in kg; ESTIMATE: that of the planets");
    add("inertia_carrier", fmt::format("{:.4g}", 1e-6 * mass * centre() * centre()),
        "its moment of inertia in kg m^2; ESTIMATE: the same mass on the circle of the pins");
  }

  void add_bearings() {
    constexpr double kBearing = 2e8;  // N/m
    const std::string value = fmt::format("{:g}", kBearing);
    add("k_sun", value,
        "bearings of the sun in N/m; ESTIMATE: those of two ball bearings. 0: the sun floats");
    add("k_pin", value,
        "pin and bearings of a planet in N/m; ESTIMATE: those of two ball bearings");
    add("k_carrier", value, "bearings of the carrier in N/m; ESTIMATE: those of two ball bearings");
    // Teeth have about 20 N/(mm um).
    const double teeth = 2e10 * 1e-3 * width_ * 1e-6 * centre() * centre();
    add("turn_carrier", fmt::format("{:g}", rounded(0.01 * teeth)),
        "output shaft, to what it drives, in N m/rad; ESTIMATE: a hundredth of what the teeth are, "
        "so that it hardly matters");
    add("k0_ring", "\"k0_sun\"",
        "mean mesh stiffness of planet and ring in N/m; without it: that of sun and planet", true);
    add("b_ring", "\"b_sun\"",
        "half backlash of planet and ring in half backlashes of sun and planet; without it: the "
        "same",
        true);
  }

  const NewUnit& unit_;
  double reference_ = 0.0, alpha_ = 0.0, width_ = 0.0;
  UnitText text_;
};

}  // namespace

std::string new_unit_study(const NewUnit& unit) {
  const bool is_idler = unit.arrangement == GearArrangement::idler;
  UnitText text = is_idler                                          ? idler_text(unit)
                  : unit.arrangement == GearArrangement::two_stages ? two_stages_text(unit)
                                                                    : PlanetarySetText(unit).run();
  set_torque(unit, &text.drawings.front().second);
  text.about += kEstimates;
  const std::string source = is_idler                    ? "the new gears"
                             : text.model == "planetary" ? "the new planetary set"
                                                         : "the new stages";
  return unit_text(std::move(text), source);
}

}  // namespace gearsweep
