// The harmonics of the transmission error.
#pragma once

#include "gear/detail/contact_path.hpp"

namespace gearsweep {

// How much the stiffness of a pair falls towards its ends, as gear5's option `parabolic` has it by
// default: its parameter q.
inline constexpr double kParabolicFall = 0.35;

// Adds the transmission error in half backlashes `b_n`, which is in m, with what the profile's
// deviations make of it. Returns whether one sine is enough. Throws DrawingError.
bool add_transmission_error(const GearDrawing& drawing, const GearGeometry& geometry,
                            const ContactPath& path, double b_n, GearTarget* target);

}  // namespace gearsweep
