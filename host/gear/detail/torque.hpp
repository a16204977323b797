// The torque on the pinion: constant, or measured over its turn.
#pragma once

#include "gear/detail/bases.hpp"
#include "gear/detail/target.hpp"

namespace gearsweep {

// N m: torque_N_m, or the mean of torque_file. Throws DrawingError where there is neither.
double mean_torque(const GearDrawing& drawing);

// The mean load, and what the torque adds to it over a turn of the pinion. Throws DrawingError.
void add_torque(const GearDrawing& drawing, const GearBases& bases, GearTarget* target);

}  // namespace gearsweep
