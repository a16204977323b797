// Where on the line of action teeth are in contact.
#pragma once

#include "gear/detail/geometry.hpp"
#include "gear/detail/target.hpp"

namespace gearsweep {

// In base pitches: from entry to the pitch point and on to exit.
struct ContactPath {
  double approach, recess;
  double contact_ratio() const { return approach + recess; }
};

// Adds eps and approach; returns the path of contact in use. Throws DrawingError.
ContactPath add_contact_path(const GearDrawing& drawing, const GearGeometry& geometry,
                             GearTarget* target);

}  // namespace gearsweep
