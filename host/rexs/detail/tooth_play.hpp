// The play between the teeth of a stage.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "rexs/gear_unit.hpp"

namespace gearsweep {

// Two gears as they stand: sizes in mm, angles in rad.
struct StageGeometry {
  double teeth = 0.0;  // of both
  double module = 0.0, helix = 0.0, alpha = 0.0;
  double centre = 0.0;
  double shifts = 0.0;  // their sum

  double transverse_alpha() const;
  // At the centre distance.
  double working_alpha() const;
  double base_helix() const;
};

// The sum of the shifts at which the teeth stand without play at the centre distance; nothing where
// the base circles do not fit in it.
std::optional<double> shifts_without_play(const StageGeometry& geometry);

struct ToothPlay {
  double along = 0.0;  // the line of action in the transverse section, mm
  std::string origin;
};

// By the stage's normal or transverse backlash; else by the deviations of both gears' tooth
// thickness and what the centre distance leaves with their shifts. Nothing where the file has
// neither.
std::optional<ToothPlay> tooth_play(const UnitStage& stage,
                                    const std::array<const UnitGear*, 2>& gears,
                                    const StageGeometry& geometry);

}  // namespace gearsweep
