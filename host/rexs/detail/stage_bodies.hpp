// What turns with the gears of a stage, and what holds it.
#pragma once

#include <array>

#include "rexs/stage_drawing.hpp"

namespace gearsweep {

// Masses and inertias: those of the gears' shafts with all that is on them.
void add_bodies(const GearUnit& unit, const std::array<const UnitGear*, 2>& gears,
                StageDrawing* drawing);

// The stiffness of the bearings on these shafts, where the file has it of all.
void add_bearings(const GearUnit& unit, const std::array<const UnitGear*, 2>& gears,
                  StageDrawing* drawing);

}  // namespace gearsweep
