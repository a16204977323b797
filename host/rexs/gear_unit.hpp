// A gear unit as a file of REXS gives it: stages, shafts with their bodies, bearings, load cases.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rexs/document.hpp"

namespace gearsweep {

// Numbers are in mm, degrees, kg, kg mm^2, N/mm, N m and rpm.
struct UnitGear {
  std::string id, name;
  bool is_ring = false;
  std::optional<double> teeth, module, helix, pressure_angle, shift, face_width, tip_diameter,
      addendum, dedendum;
  std::optional<std::size_t> shaft;
};

struct UnitShaft {
  std::string id, name;
  double mass = 0.0, inertia = 0.0;  // of its sections, and of the gears and masses on it
  std::vector<std::string> bodies;   // what is counted, "shaft sections 4.2 kg"
  std::optional<double> speed;       // without load cases
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
  std::optional<double> centre_distance, face_width, contact_ratio, backlash;  // backlash: normal
  std::string refusal;  // why no study can be made of it; else empty
};

// Of one load case, or of the unit itself where the file has none.
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
  std::vector<UnitCase> cases;     // at least one
  std::vector<std::string> notes;  // what is odd, and what was not taken, one line each
};

// Masses are estimates: of the sections as they are drawn, of gears as discs of their reference
// diameter on the shaft's outside, with the density of the material, or steel's. Torques follow
// where the loads on one side of a mesh are known, without losses.
GearUnit gear_unit_of(const RexsDocument& document);

}  // namespace gearsweep
