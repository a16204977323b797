// The geometry of a gear pair.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "gear/drawing.hpp"

namespace gearsweep {

// Lengths in mm, angle in rad.
struct GearGeometry {
  double pinion_teeth, gear_teeth, module;
  double pinion_base, gear_base;  // base radii Rp, Rg
  double alpha;                   // working pressure angle
  double normal_alpha;            // of the tool
  double centre;                  // centre distance
  double base_pitch;              // transverse, as all of these but the module
  double helix;                   // at the reference circle
  std::vector<double> shift;      // profile shift coefficients
  // Reference radii.
  double reference(double teeth) const { return module / std::cos(helix) * teeth / 2.0; }
  // The overlap ratio of a face width in mm.
  double overlap(double width) const {
    return width * std::sin(helix) / (std::numbers::pi * module);
  }
};

inline double involute(double angle) { return std::tan(angle) - angle; }

// Within a part in a million of the standard centre distance the tool's pressure angle is kept, so
// that a rounded drawing gives the same gear as no centre distance at all. Throws DrawingError.
GearGeometry geometry_of(const GearDrawing& drawing);

}  // namespace gearsweep
