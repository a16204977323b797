// What comes back once per turn of a gear: runout, pitch errors, a damaged tooth.
#pragma once

#include "gear/detail/geometry.hpp"
#include "gear/detail/target.hpp"

namespace gearsweep {

// Adds them, and the cycle; b_n in m. Returns whether there is any runout or pitch error. Throws
// DrawingError.
bool add_faults(const GearDrawing& drawing, const GearGeometry& geometry, double b_n,
                GearTarget* target);

}  // namespace gearsweep
