// What the drawing of a gear pair may say: keys, whose names have the unit, and their ranges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "gear/value_units.hpp"

namespace gearsweep {

// What a key takes. A number may stand for all of a list but one of teeth.
enum class KeyForm : std::uint8_t {
  number,
  teeth,      // [pinion, gear]
  pair,       // the same
  bearings,   // [pinion x, pinion y, gear x, gear y]
  harmonics,  // as many as there are
  word,
  mesh_curve,  // measured, over a mesh period, or over a turn
  tooth_list,  // measured, a number for each tooth
  path_curve   // measured, over the path of contact
};

using GivenNames = std::array<std::string_view, 4>;  // those that are empty are none

struct GearKey {
  std::string_view name;
  double min, max;  // of its numbers, both ends included, in its own unit
  std::string_view meaning;
  KeyForm form;
  std::string_view fallback;  // what a drawing without the key has, in words
  // Parameters and curves that come from this key alone. A model that has one of them needs it.
  GivenNames gives = {};
  std::string_view choices = "";          // of a word, with blanks between
  std::span<const ValueUnit> units = {};  // of what is measured, that its source may name
  std::string_view advice = "";           // where to get what a drawing needs and does not have

  constexpr bool is_measured() const { return form >= KeyForm::mesh_curve; }
  // Whether it may be a number that differs from point to point. Those of teeth are whole, and come
  // in pairs.
  constexpr bool can_vary() const { return form < KeyForm::word && form != KeyForm::teeth; }
  // How many numbers it has; of harmonics 0: any.
  constexpr std::size_t count() const {
    if (form == KeyForm::harmonics) return 0;
    return form == KeyForm::number ? 1 : form == KeyForm::bearings ? 4 : 2;
  }
  // What its numbers are in: "N s/mm" for mesh_damping_N_s_per_mm; "1" without a unit.
  std::string unit() const;
};

constexpr GearKey number_key(std::string_view name, double min, double max,
                             std::string_view meaning, KeyForm form = KeyForm::number,
                             std::string_view fallback = "required", const GivenNames& gives = {},
                             std::string_view advice = "") {
  return {name, min, max, meaning, form, fallback, gives, "", {}, advice};
}
constexpr GearKey measured_key(std::string_view name, KeyForm form, const GivenNames& gives,
                               std::string_view meaning, std::span<const ValueUnit> units = {}) {
  return {name, 0.0, 0.0, meaning, form, "", gives, "", units};
}
constexpr GearKey word_key(std::string_view name, std::string_view choices,
                           std::string_view fallback, std::string_view meaning,
                           const GivenNames& gives = {}) {
  return {name, 0.0, 0.0, meaning, KeyForm::word, fallback, gives, choices};
}

inline constexpr GearKey kTeeth =
    number_key("teeth", 3.0, 1000.0, "numbers of teeth", KeyForm::teeth);
inline constexpr GearKey kModule = number_key("module_mm", 1e-3, 1e3, "module");
inline constexpr GearKey kPressureAngle = number_key(
    "pressure_angle_deg", 5.0, 45.0, "pressure angle of the tool", KeyForm::number, "20");
inline constexpr GearKey kCentreDistance = number_key(
    "centre_distance_mm", 1e-3, 1e6, "centre distance", KeyForm::number, "module (z1 + z2)/2");
inline constexpr GearKey kContactRatio =
    number_key("contact_ratio", 0.0, 10.0, "contact ratio", KeyForm::number, "from the geometry");
inline constexpr GearKey kAddendum =
    number_key("addendum_mm", 0.0, 1e4, "addendum", KeyForm::pair, "one module");
inline constexpr GearKey kInertia = number_key(
    "inertia_kg_mm2", 1e-9, 1e15, "moment of inertia", KeyForm::pair, "needed without body", {},
    "from CAD, or body = \"solid\" with face_width_mm: that of a steel disc");
inline constexpr GearKey kMass =
    number_key("mass_kg", 1e-9, 1e9, "mass", KeyForm::pair, "needed without body", {"m1", "m2"},
               "from CAD, or body = \"solid\" with face_width_mm: that of a steel disc");
inline constexpr GearKey kBody = word_key(
    "body", "given solid", "\"given\"",
    "solid: a mass or an inertia that is not given is that of a steel disc of the reference "
    "diameter, face_width_mm wide, with a bore of bore_mm");
inline constexpr GearKey kBore =
    number_key("bore_mm", 0.0, 1e6, "bore of these discs", KeyForm::pair, "0");
// Palmgren's deflections, 0.00044 (Q^2/D)^(1/3) mm of a ball and 0.000077 Q^0.9/l^0.8 mm of a
// roller, with Q = 4.37 and 4.08 F/Z (NSK, Technical Report E728g, 5.1); bearings 6204, 6210, N 204
// and N 210 under 1 kN.
inline constexpr GearKey kBearingStiffness = number_key(
    "bearing_stiffness_N_per_mm", 1e-6, 1e15, "bearing stiffness, y along the line of action",
    KeyForm::bearings, "required", {"k1", "k2", "k3", "k4"},
    "radial, of both bearings of the shaft together, from their maker's program; under 1 kN a "
    "deep-groove ball bearing has about 1e5 at a bore of 20 mm and 1.5e5 at 50 mm, a cylindrical "
    "roller bearing 3e5 and 6e5, and the shaft and the housing take a part of it");
// Kraemer, Dynamics of Rotors and Foundations (1993): 0.25e-5 to 2.5e-5 s times the stiffness.
inline constexpr GearKey kBearingDamping =
    number_key("bearing_damping_N_s_per_mm", 0.0, 1e12, "bearing damping", KeyForm::bearings,
               "required", {"c1", "c2", "c3", "c4"},
               "of rolling bearings 0.25e-5 to 2.5e-5 times bearing_stiffness_N_per_mm");
inline constexpr GearKey kMeshDamping = number_key(
    "mesh_damping_N_s_per_mm", 0.0, 1e12,
    "mesh damping, of each of the two pairs that gear5 has at all times", KeyForm::number,
    "needed without mesh_damping_ratio", {"zeta"},
    "measured, or mesh_damping_ratio = 0.07: gears have 0.03 to 0.17 of the critical damping");
inline constexpr GearKey kDampingRatio =
    number_key("mesh_damping_ratio", 0.0, 10.0,
               "instead of it: damping of the whole mesh over its critical value "
               "2 sqrt(k0 me)",
               KeyForm::number, "from mesh_damping_N_s_per_mm", {"zeta"});
inline constexpr GearKey kHalfBacklash = number_key(
    "half_backlash_mm", 1e-9, 1e3, "half backlash, the unit of length", KeyForm::number, "required",
    {}, "half of the play along the line of action; it is often 0.03 to 0.1 modules");
inline constexpr GearKey kMeshStiffness =
    number_key("mesh_stiffness_N_per_m", 1e-3, 1e15, "mean mesh stiffness", KeyForm::number,
               "by ISO 6336-1 method B from face_width_mm");
inline constexpr GearKey kStiffnessFactor = number_key(
    "stiffness_factor", 1e-3, 1e3,
    "what the mesh stiffness is multiplied by, as where misaligned teeth bear on a part of their "
    "width; the units of the result stay those without it",
    KeyForm::number, "1", {"stiffness_factor"});
inline constexpr GearKey kFaceWidth =
    number_key("face_width_mm", 1e-3, 1e5, "face width", KeyForm::number,
               "needed without mesh_stiffness_N_per_m", {},
               "from the drawing; or mesh_stiffness_N_per_m, of steel about 14e9 to 20e9 times the "
               "width in m");
inline constexpr GearKey kDedendum = number_key(
    "dedendum_mm", 0.0, 1e4, "dedendum of the basic rack, for the stiffness by face_width_mm",
    KeyForm::number, "1.25 modules");
inline constexpr GearKey kTorque = number_key(
    "torque_N_m", 0.0, 1e12, "torque on the pinion", KeyForm::number, "needed without torque_file",
    {"F1"}, "9549 times the power in kW over the pinion's speed in rpm");
inline constexpr GearKey kTorqueFile = measured_key(
    "torque_file", KeyForm::mesh_curve, {"torque_swing"},
    "measured torque on the pinion over its turn, in N m or the unit of its heading, instead of "
    "torque_N_m, or what swings about that",
    kTorqueUnits);
inline constexpr GearKey kTransmissionError =
    number_key("transmission_error_um", 0.0, 1e9, "amplitudes of the transmission error",
               KeyForm::harmonics, "needed without transmission_error_file", {"e0"},
               "measured without load; ground gears have a few um, hobbed ones 10 to 30; 0: none");
inline constexpr GearKey kErrorPhase =
    number_key("transmission_error_phase_deg", -3600.0, 3600.0, "their phases where a pair enters",
               KeyForm::harmonics, "0", {"e0_phase"});
inline constexpr GearKey kRunout = number_key(
    "runout_um", 0.0, 1e9, "amplitude of the error that eccentricity makes once per turn",
    KeyForm::pair, "0", {"runout_p", "runout_g"});
inline constexpr GearKey kRunoutPhase =
    number_key("runout_phase_deg", -3600.0, 3600.0, "its phase where tooth 0 enters", KeyForm::pair,
               "0", {"runout_phase_p", "runout_phase_g"});
inline constexpr GearKey kDamage =
    number_key("damage", 0.0, 1.0, "share by which a damaged tooth 0 weakens its pair",
               KeyForm::pair, "0", {"damage_p", "damage_g"});
inline constexpr GearKey kPinionDamage = measured_key(
    "pinion_damage_file", KeyForm::path_curve, {"damage_curve_p"},
    "instead of damage: the share, 0 to 1, by which the pinion's tooth 0 weakens its pair");
inline constexpr GearKey kGearDamage = measured_key(
    "gear_damage_file", KeyForm::path_curve, {"damage_curve_g"}, "the same of the gear's tooth 0");
inline constexpr GearKey kErrorFile =
    measured_key("transmission_error_file", KeyForm::mesh_curve, {"e0", "e0_phase"},
                 "measured transmission error over a mesh period, in um or the unit of its "
                 "heading, instead of amplitudes; its first 8 harmonics are taken",
                 kLengthUnits);
inline constexpr GearKey kProfileFile = measured_key(
    "profile_deviation_file", KeyForm::path_curve, {"e0", "e0_phase"},
    "what corrections and wear take away from a pair of flanks, in um or the unit of its heading",
    kLengthUnits);
inline constexpr GearKey kPinionPitch = measured_key(
    "pinion_pitch_error_file", KeyForm::tooth_list, {"pitch_p", "pitch_bend_p"},
    "pitch errors of the pinion where each tooth enters, in um or the unit of its heading",
    kLengthUnits);
inline constexpr GearKey kGearPitch = measured_key(
    "gear_pitch_error_file", KeyForm::tooth_list, {"pitch_g", "pitch_bend_g"},
    "pitch errors of the gear where each tooth enters, in um or the unit of its heading",
    kLengthUnits);
inline constexpr GearKey kStiffnessFile =
    measured_key("stiffness_file", KeyForm::mesh_curve, {"measured_stiffness"},
                 "measured mesh stiffness over a mesh period, in N/m or the unit of its heading",
                 kStiffnessUnits);
inline constexpr GearKey kLoadShareFile =
    measured_key("load_share_file", KeyForm::mesh_curve, {"load_share"},
                 "with it: the share, 0 to 1, of the pair that entered last");
inline constexpr GearKey kStiffnessMean = word_key(
    "stiffness_mean", "keep normalise", "\"keep\"",
    "keep: its mean may differ from mesh_stiffness_N_per_m; normalise: it is scaled to that");
inline constexpr GearKey kInterpolation = word_key(
    "stiffness_interpolation", "linear cubic", "\"linear\"", "between the points of these files");
inline constexpr GearKey kProfileShift =
    number_key("profile_shift", -2.0, 2.0, "profile shift coefficients", KeyForm::pair, "0");
inline constexpr GearKey kTipDiameter =
    number_key("tip_diameter_mm", 1e-3, 1e6, "tip diameters, instead of the addendum",
               KeyForm::pair, "from the addendum");
inline constexpr GearKey kHelix =
    number_key("helix_angle_deg", 0.0, 45.0, "helix angle, with face_width_mm", KeyForm::number,
               "0", {"overlap"});
inline constexpr GearKey kEngagement = number_key(
    "engagement", 0.0, 0.5,
    "share of a base pitch over which a pair of spur teeth takes up its load, and gives it back",
    KeyForm::number, "0", {"engagement"});
inline constexpr GearKey kToothEntry = word_key(
    "tooth_entry", "sudden gradual", "\"sudden\"",
    "gradual: engagement is estimated from the deflection of a pair of teeth under torque_N_m",
    {"engagement"});
inline constexpr GearKey kSpeed = number_key("pinion_speed_rpm", 1e-6, 1e9, "speed of the pinion",
                                             KeyForm::number, "omega stays as it is", {"omega"});
inline constexpr GearKey kPitchDeviation =
    number_key("pitch_deviation_um", 0.0, 1e4,
               "deviation f_pb of the base pitch, for K_v in a report", KeyForm::number, "no K_v");
inline constexpr GearKey kProfileDeviation =
    number_key("profile_form_deviation_um", 0.0, 1e4,
               "with it: form deviation f_falpha of the profile", KeyForm::number, "no K_v");
inline constexpr GearKey kTipRelief = number_key(
    "tip_relief_um", 0.0, 1e4, "with both: tip relief C_a, of accuracy grade 5 and better",
    KeyForm::number, "B_k = 1");

inline constexpr GearKey kGearKeys[] = {kTeeth,
                                        kModule,
                                        kPressureAngle,
                                        kCentreDistance,
                                        kContactRatio,
                                        kAddendum,
                                        kInertia,
                                        kMass,
                                        kBody,
                                        kBore,
                                        kBearingStiffness,
                                        kBearingDamping,
                                        kMeshDamping,
                                        kDampingRatio,
                                        kHalfBacklash,
                                        kMeshStiffness,
                                        kStiffnessFactor,
                                        kFaceWidth,
                                        kDedendum,
                                        kTorque,
                                        kTorqueFile,
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
                                        kEngagement,
                                        kToothEntry,
                                        kSpeed,
                                        kPitchDeviation,
                                        kProfileDeviation,
                                        kTipRelief};

}  // namespace gearsweep
