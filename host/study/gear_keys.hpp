// The keys of the [gear] table, their ranges, and how they are read. Private to this folder.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/toml_access.hpp"

namespace gearsweep {

// A key of the table with its allowed range, in its own unit.
struct GearKey {
  std::string_view name;
  double least, greatest;
  std::string_view meaning;
};

inline constexpr GearKey kTeeth{"teeth", 3.0, 1000.0, "numbers of teeth, [pinion, gear]"};
inline constexpr GearKey kModule{"module_mm", 1e-3, 1e3, "module"};
inline constexpr GearKey kPressureAngle{"pressure_angle_deg", 5.0, 45.0,
                                        "pressure angle of the tool"};
inline constexpr GearKey kCentreDistance{"centre_distance_mm", 1e-3, 1e6, "centre distance"};
inline constexpr GearKey kContactRatio{"contact_ratio", 0.0, 10.0, "contact ratio"};
inline constexpr GearKey kAddendum{"addendum_mm", 0.0, 1e4,
                                   "addendum, one number or [pinion, gear]"};
inline constexpr GearKey kInertia{"inertia_kg_mm2", 1e-9, 1e15,
                                  "moment of inertia, one or [pinion, gear]"};
inline constexpr GearKey kMass{"mass_kg", 1e-9, 1e9, "mass, one number or [pinion, gear]"};
inline constexpr GearKey kBearingStiffness{"bearing_stiffness_N_per_mm", 1e-6, 1e15,
                                           "bearing stiffness, one number or 4"};
inline constexpr GearKey kBearingDamping{"bearing_damping_N_s_per_mm", 0.0, 1e12,
                                         "bearing damping, one number or 4"};
inline constexpr GearKey kMeshDamping{"mesh_damping_N_s_per_mm", 0.0, 1e12, "mesh damping"};
inline constexpr GearKey kHalfBacklash{"half_backlash_mm", 1e-9, 1e3,
                                       "half backlash, the unit of length"};
inline constexpr GearKey kMeshStiffness{"mesh_stiffness_N_per_m", 1e-3, 1e15,
                                        "mean mesh stiffness"};
inline constexpr GearKey kFaceWidth{"face_width_mm", 1e-3, 1e5, "face width"};
inline constexpr GearKey kTorque{"torque_N_m", 0.0, 1e12, "torque on the pinion"};
inline constexpr GearKey kTransmissionError{"transmission_error_um", 0.0, 1e9,
                                            "amplitude of the transmission error"};
inline constexpr GearKey kSpeed{"pinion_speed_rpm", 1e-6, 1e9, "speed of the pinion"};

inline constexpr std::array kGearKeys = {
    kTeeth,         kModule,    kPressureAngle,    kCentreDistance,    kContactRatio, kAddendum,
    kInertia,       kMass,      kBearingStiffness, kBearingDamping,    kMeshDamping,  kHalfBacklash,
    kMeshStiffness, kFaceWidth, kTorque,           kTransmissionError, kSpeed};

// The table by keys. All its numbers are in the units of the keys.
class GearReader {
 public:
  explicit GearReader(const toml::table& gear) : gear_(gear), reader_(&gear, "[gear]") {
    for (const GearKey& key : kGearKeys) reader_.know(std::string(key.name));
    reader_.refuse_unknown();
  }

  bool has(const GearKey& key) const { return gear_.contains(key.name); }

  // What a message about this key should point at: the key, or the table that lacks it.
  const toml::node& node(const GearKey& key) const {
    const toml::node* found = gear_.get(key.name);
    return found == nullptr ? gear_ : *found;
  }

  std::optional<double> optional(const GearKey& key) {
    return reader_.optional_number(std::string(key.name), key.least, key.greatest);
  }

  double required(const GearKey& key) {
    need(key);
    return *optional(key);
  }

  // `count` numbers, or one that stands for all of them.
  std::vector<double> list(const GearKey& key, std::size_t count) {
    need(key);
    std::vector<double> values = reader_.numbers(std::string(key.name), key.least, key.greatest);
    if (!node(key).is_array()) values.assign(count, values.front());
    if (values.size() != count) {
      fail_at(node(key), fmt::format("{} has {} numbers; it needs one number or a list of {}",
                                     key.name, values.size(), count));
    }
    return values;
  }

 private:
  void need(const GearKey& key) const {
    if (!has(key)) fail_at(gear_, fmt::format("[gear] needs '{}' ({})", key.name, key.meaning));
  }

  const toml::table& gear_;
  TableReader reader_;
};

}  // namespace gearsweep
