// The keys of the [gear] table, their ranges, and how they are read.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/names.hpp"
#include "study/detail/toml_access.hpp"
#include "study/value_units.hpp"

namespace gearsweep {

// What a key takes, in words.
inline constexpr std::string_view kPair = "number or [pinion, gear]";
inline constexpr std::string_view kFile = "file beside the study";
inline constexpr std::string_view kFilePerTooth = "file with a number per tooth";
inline constexpr std::string_view kFileOverPath = "file over the path of contact";
inline constexpr std::string_view kWord = "string";
inline constexpr std::string_view kHarmonics = "number or list, harmonic by harmonic";
inline constexpr std::string_view kBearings = "number or [pinion x, pinion y, gear x, gear y]";

// A key of the table with its allowed range, in its own unit. `type` and `fallback` (what a table
// without the key has) are in words.
struct GearKey {
  std::string_view name;
  double min, max;
  std::string_view meaning;
  std::string_view type = "number", fallback = "required";
  std::string_view choices = "";          // of a word, with blanks between
  std::span<const ValueUnit> units = {};  // of a file that names one in its heading

  constexpr bool is_file() const {
    return type == kFile || type == kFilePerTooth || type == kFileOverPath;
  }
  constexpr bool is_number() const { return !is_file() && choices.empty(); }
};

inline constexpr GearKey kTeeth{"teeth", 3.0, 1000.0, "numbers of teeth", "[pinion, gear]"};
inline constexpr GearKey kModule{"module_mm", 1e-3, 1e3, "module"};
inline constexpr GearKey kPressureAngle{"pressure_angle_deg",         5.0,      45.0,
                                        "pressure angle of the tool", "number", "20"};
inline constexpr GearKey kCentreDistance{"centre_distance_mm", 1e-3,     1e6,
                                         "centre distance",    "number", "module (z1 + z2)/2"};
inline constexpr GearKey kContactRatio{"contact_ratio", 0.0,      10.0,
                                       "contact ratio", "number", "from the geometry"};
inline constexpr GearKey kAddendum{"addendum_mm", 0.0, 1e4, "addendum", kPair, "one module"};
inline constexpr GearKey kInertia{"inertia_kg_mm2", 1e-9, 1e15, "moment of inertia", kPair};
inline constexpr GearKey kMass{"mass_kg", 1e-9, 1e9, "mass", kPair};
inline constexpr GearKey kBearingStiffness{"bearing_stiffness_N_per_mm", 1e-6, 1e15,
                                           "bearing stiffness, y along the line of action",
                                           kBearings};
inline constexpr GearKey kBearingDamping{"bearing_damping_N_s_per_mm", 0.0, 1e12, "bearing damping",
                                         kBearings};
inline constexpr GearKey kMeshDamping{"mesh_damping_N_s_per_mm", 0.0, 1e12, "mesh damping"};
inline constexpr GearKey kHalfBacklash{"half_backlash_mm", 1e-9, 1e3,
                                       "half backlash, the unit of length"};
inline constexpr GearKey kMeshStiffness{
    "mesh_stiffness_N_per_m", 1e-3,     1e15,
    "mean mesh stiffness",    "number", "by ISO 6336-1 method B from face_width_mm"};
inline constexpr GearKey kFaceWidth{
    "face_width_mm", 1e-3, 1e5, "face width", "number", "needed without mesh_stiffness_N_per_m"};
inline constexpr GearKey kDedendum{
    "dedendum_mm", 0.0,
    1e4,           "dedendum of the basic rack, for the stiffness by face_width_mm",
    "number",      "1.25 modules"};
inline constexpr GearKey kTorque{"torque_N_m", 0.0, 1e12, "torque on the pinion"};
inline constexpr GearKey kTransmissionError{"transmission_error_um",
                                            0.0,
                                            1e9,
                                            "amplitudes of the transmission error",
                                            kHarmonics,
                                            "needed without transmission_error_file"};
inline constexpr GearKey kErrorPhase{"transmission_error_phase_deg",     -3600.0,    3600.0,
                                     "their phases where a pair enters", kHarmonics, "0"};
inline constexpr GearKey kRunout{
    "runout_um", 0.0, 1e9, "amplitude of the error that eccentricity makes once per turn",
    kPair,       "0"};
inline constexpr GearKey kRunoutPhase{
    "runout_phase_deg", -3600.0, 3600.0, "its phase where tooth 0 enters", kPair, "0"};
inline constexpr GearKey kDamage{
    "damage", 0.0, 1.0, "share by which a damaged tooth 0 weakens its pair", kPair, "0"};
inline constexpr GearKey kPinionDamage{
    "pinion_damage_file",
    0.0,
    0.0,
    "instead of damage: the share, 0 to 1, by which the pinion's tooth 0 weakens its pair",
    kFileOverPath,
    ""};
inline constexpr GearKey kGearDamage{"gear_damage_file", 0.0, 0.0, "the same of the gear's tooth 0",
                                     kFileOverPath,      ""};
inline constexpr GearKey kErrorFile{
    "transmission_error_file",
    0.0,
    0.0,
    "measured transmission error over a mesh period, in um or the unit of its heading, instead of "
    "amplitudes; its first 8 harmonics are taken",
    kFile,
    "",
    "",
    kLengthUnits};
inline constexpr GearKey kProfileFile{
    "profile_deviation_file",
    0.0,
    0.0,
    "what corrections and wear take away from a pair of flanks, in um or the unit of its heading",
    kFileOverPath,
    "",
    "",
    kLengthUnits};
inline constexpr GearKey kPinionPitch{
    "pinion_pitch_error_file",
    0.0,
    0.0,
    "pitch errors of the pinion where each tooth enters, in um or the unit of its heading",
    kFilePerTooth,
    "",
    "",
    kLengthUnits};
inline constexpr GearKey kGearPitch{
    "gear_pitch_error_file",
    0.0,
    0.0,
    "pitch errors of the gear where each tooth enters, in um or the unit of its heading",
    kFilePerTooth,
    "",
    "",
    kLengthUnits};
inline constexpr GearKey kStiffnessFile{
    "stiffness_file",
    0.0,
    0.0,
    "measured mesh stiffness over a mesh period, in N/m or the unit of its heading",
    kFile,
    "",
    "",
    kStiffnessUnits};
inline constexpr GearKey kLoadShareFile{"load_share_file",
                                        0.0,
                                        0.0,
                                        "with it: the share, 0 to 1, of the pair that entered last",
                                        kFile,
                                        ""};
inline constexpr GearKey kStiffnessMean{
    "stiffness_mean",
    0.0,
    0.0,
    "keep: its mean may differ from mesh_stiffness_N_per_m; normalise: it is scaled to that",
    kWord,
    "\"keep\"",
    "keep normalise"};
inline constexpr GearKey kInterpolation{"stiffness_interpolation",
                                        0.0,
                                        0.0,
                                        "between the points of these files",
                                        kWord,
                                        "\"linear\"",
                                        "linear cubic"};
inline constexpr GearKey kProfileShift{"profile_shift", -2.0, 2.0, "profile shift coefficients",
                                       kPair,           "0"};
inline constexpr GearKey kTipDiameter{
    "tip_diameter_mm",  1e-3, 1e6, "tip diameters, instead of the addendum", kPair,
    "from the addendum"};
inline constexpr GearKey kHelix{"helix_angle_deg", 0.0, 45.0, "helix angle, with face_width_mm",
                                "number",          "0"};
inline constexpr GearKey kSpeed{"pinion_speed_rpm",    1e-6,     1e9,
                                "speed of the pinion", "number", "omega stays as it is"};
inline constexpr GearKey kPitchDeviation{"pitch_deviation_um",
                                         0.0,
                                         1e4,
                                         "deviation f_pb of the base pitch, for K_v in a report",
                                         "number",
                                         "no K_v"};
inline constexpr GearKey kProfileDeviation{"profile_form_deviation_um",
                                           0.0,
                                           1e4,
                                           "with it: form deviation f_falpha of the profile",
                                           "number",
                                           "no K_v"};
inline constexpr GearKey kTipRelief{
    "tip_relief_um", 0.0,      1e4, "with both: tip relief C_a, of accuracy grade 5 and better",
    "number",        "B_k = 1"};

inline constexpr std::array kGearKeys = {kTeeth,
                                         kModule,
                                         kPressureAngle,
                                         kCentreDistance,
                                         kContactRatio,
                                         kAddendum,
                                         kInertia,
                                         kMass,
                                         kBearingStiffness,
                                         kBearingDamping,
                                         kMeshDamping,
                                         kHalfBacklash,
                                         kMeshStiffness,
                                         kFaceWidth,
                                         kDedendum,
                                         kTorque,
                                         kTransmissionError,
                                         kErrorPhase,
                                         kRunout,
                                         kRunoutPhase,
                                         kDamage,
                                         kPinionDamage,
                                         kGearDamage,
                                         kErrorFile,
                                         kProfileFile,
                                         kPinionPitch,
                                         kGearPitch,
                                         kStiffnessFile,
                                         kLoadShareFile,
                                         kStiffnessMean,
                                         kInterpolation,
                                         kProfileShift,
                                         kTipDiameter,
                                         kHelix,
                                         kSpeed,
                                         kPitchDeviation,
                                         kProfileDeviation,
                                         kTipRelief};

// Numbers that stand in place of those of the table, by the names of keys.
using GearValues = std::map<std::string, double>;

// The table by keys. All its numbers are in the units of the keys.
class GearReader {
 public:
  GearReader(const toml::table& gear, const GearValues& values)
      : gear_(gear), values_(values), reader_(&gear, "[gear]") {
    for (const GearKey& key : kGearKeys) reader_.know(std::string(key.name));
    reader_.know("tables");
    reader_.refuse_unknown();
  }

  // The numbers of files, by their names; nullptr where there are none.
  const toml::table* tables() const { return gear_["tables"].as_table(); }

  std::optional<std::string> text(const GearKey& key) {
    const std::string name(key.name);
    if (reader_.find(name) == nullptr) return std::nullopt;
    return reader_.text(name, "");
  }

  // One of its choices, the first where the table has no such key.
  std::string choice(const GearKey& key) {
    const std::vector<std::string> choices = split_words(std::string(key.choices));
    return choices[reader_.choice(std::string(key.name), 0, choices)];
  }

  // An axis gives its values.
  bool is_swept(const GearKey& key) const { return value_of(key).has_value(); }
  bool has(const GearKey& key) const { return value_of(key) || gear_.contains(key.name); }

  // What a message about this key should point at: the key, or the table that lacks it.
  const toml::node& node(const GearKey& key) const {
    const toml::node* found = gear_.get(key.name);
    return found == nullptr ? gear_ : *found;
  }

  std::optional<double> optional(const GearKey& key) {
    if (const std::optional<double> value = value_of(key)) return value;
    return reader_.optional_number(std::string(key.name), key.min, key.max);
  }

  double required(const GearKey& key) {
    need(key);
    return *optional(key);
  }

  // `count` numbers, or one that stands for all of them.
  std::vector<double> list(const GearKey& key, std::size_t count) {
    need(key);
    if (const std::optional<double> value = value_of(key)) {
      return std::vector<double>(count, *value);
    }
    std::vector<double> values = reader_.numbers(std::string(key.name), key.min, key.max);
    if (!node(key).is_array()) values.assign(count, values.front());
    if (values.size() != count) {
      fail_at(node(key), fmt::format("{} has {} numbers; it needs one number or a list of {}",
                                     key.name, values.size(), count));
    }
    return values;
  }

  // As many numbers as there are; none where the table has no such key. An axis gives the first.
  std::vector<double> numbers(const GearKey& key) {
    std::vector<double> values = reader_.numbers(std::string(key.name), key.min, key.max);
    if (const std::optional<double> value = value_of(key)) {
      values.resize(std::max<std::size_t>(values.size(), 1));
      values.front() = *value;
    }
    return values;
  }

  // A pair that may be missing: two zeros then.
  std::vector<double> pair_or_zero(const GearKey& key) {
    return has(key) ? list(key, 2) : std::vector<double>(2, 0.0);
  }

 private:
  std::optional<double> value_of(const GearKey& key) const {
    const auto found = values_.find(std::string(key.name));
    return found == values_.end() ? std::nullopt : std::optional(found->second);
  }

  void need(const GearKey& key) const {
    if (!has(key)) fail_at(gear_, fmt::format("[gear] needs '{}' ({})", key.name, key.meaning));
  }

  const toml::table& gear_;
  const GearValues& values_;
  TableReader reader_;
};

}  // namespace gearsweep
