// A gear unit as a file of REXS gives it: stages, shafts with their bodies, bearings, load cases.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rexs/document.hpp"

namespace gearsweep {

// What a tip relief takes away from a flank, from a place on: at the tip all of its depth.
struct TipRelief {
  double depth = 0.0;              // mm
  std::optional<double> diameter;  // where it begins
  std::optional<double> length;    // else this way along the line of action before the tip
  bool is_parabolic = false;       // otherwise linear
  std::string label;               // "tip_relief 12 (tip_relief_depth = 20 mum)"
};

// Numbers are in mm, degrees, kg, kg mm^2, N/mm, N m and rpm.
struct UnitGear {
  std::string id, name;
  bool is_ring = false;
  std::optional<double> teeth, module, helix, pressure_angle, shift, face_width, tip_diameter,
      addendum, dedendum;
  std::optional<std::size_t> shaft;
  std::optional<double> place;             // along its shaft
  double mass = 0.0, inertia = 0.0;        // its own; 0: not known
  std::optional<double> modulus, poisson;  // of its material, N/mm^2
  std::optional<double> thinned;  // its teeth, along the normal of the flanks, by their deviations
  std::string thinned_by;         // the attribute of these
  std::optional<TipRelief> tip_relief;
  std::vector<std::string> left_out;  // of its flanks and its teeth's thickness: "tip_relief 12"
};

// A piece of a shaft, a frustum of a cone with a bore that is one.
struct ShaftSection {
  double begin = 0.0, length = 0.0;
  double outer[2] = {0.0, 0.0}, inner[2] = {0.0, 0.0};  // diameters
};

struct UnitShaft {
  std::string id, name;
  double mass = 0.0, inertia = 0.0;  // of its sections, and of the gears and masses on it
  std::vector<std::string> bodies;   // what is counted, "shaft sections 4.2 kg"
  std::optional<double> speed;       // without load cases
  std::vector<ShaftSection> sections;
  std::optional<double> shear_modulus;  // of its material, N/mm^2
};

struct UnitBearing {
  std::string id, name, kind, designation;
  std::vector<std::size_t> shafts;  // one, or the two that it stands between
  std::optional<double> radial_stiffness;
};

enum class StageKind : std::uint8_t { external, internal, bevel, worm, other };

struct UnitStage {
  std::string id, name;
  StageKind kind = StageKind::other;
  std::array<std::optional<std::size_t>, 2> gears;
  std::string planetary;  // the id of the planetary stage that it is a part of; else empty
  std::optional<double> centre_distance, face_width, contact_ratio;
  std::optional<double> backlash, transverse_backlash;  // normal; on the working circles
  std::optional<double> shift_sum;                      // of both gears' profile shifts
  std::optional<double> axes_apart;                     // by the places of its shafts
  std::optional<std::size_t> driver;  // 0 or 1: the gear that drives, where the file says it
  std::string refusal;                // why no study can be made of it; else empty
};

// A planetary stage: the meshes of its sun and of its ring with the planets are stages of the unit.
struct UnitPlanetary {
  std::string id, name;
  std::optional<std::size_t> sun, ring;  // gears
  std::vector<std::size_t> planets;      // gears
  bool is_ring_held = false;             // by the casing
  // With its shafts, side plates and pins, which stand on the circle of the planets; 0: not known.
  double carrier_mass = 0.0, carrier_inertia = 0.0;
  std::vector<std::string> carrier_bodies;
  std::vector<std::size_t> carrier_shafts;  // with the pins
};

// What one load case says, or the unit itself where the file has none.
struct UnitCase {
  std::string id;
  std::optional<double> share;                 // of the time
  std::vector<std::optional<double>> torques;  // of each stage, on its first gear
  std::vector<std::optional<double>> speeds;   // the same; of a planetary stage to the carrier
};

struct GearUnit {
  std::string source, version, application;
  std::vector<UnitGear> gears;
  std::vector<UnitShaft> shafts;
  std::vector<UnitBearing> bearings;
  std::vector<UnitStage> stages;
  std::vector<UnitPlanetary> planetaries;
  std::vector<UnitCase> cases;     // at least one
  std::vector<std::string> notes;  // what is odd, and what was not taken, one line each
};

// In N m/rad, between two places along a shaft: of its sections, with its shear modulus or steel's.
// Nothing where sections do not reach from one to the other, or lie over each other.
std::optional<double> torsional_stiffness(const UnitShaft& shaft, double from, double to);

// Masses are estimates: of the sections as they are drawn, of gears as discs of their reference
// diameter on the shaft's outside, with the density of the material, or steel's. Torques follow
// where the loads on one side of a mesh are known, without losses.
GearUnit gear_unit_of(const RexsDocument& document);

}  // namespace gearsweep
