// How gradually a pair of teeth takes up its load.
#pragma once

#include "gear/detail/bases.hpp"
#include "gear/detail/contact_path.hpp"
#include "gear/detail/geometry.hpp"
#include "gear/detail/target.hpp"

namespace gearsweep {

// The gap between a tip corner of the driven gear and the flank of the driving one, in mm along the
// line of action, when contact would begin `ahead` mm later, as gears without deflection turn. tip:
// how far that gear's tip reaches from where the line of action touches its base circle, in mm.
// From the involute's definition: the point of a flank at radius r has the string sqrt(r^2 - Rb^2).
double corner_gap(double driving_base, double driven_base, double alpha, double tip, double ahead);

// Adds `engagement`: as given, or of tooth_entry = "gradual" from the deflection. While one pair
// has all the load, it gives way by F/c', and so far ahead the next pair touches as its gap is no
// larger. The mean of entry and exit is taken, at most half a base pitch. Throws DrawingError.
void add_engagement(const GearDrawing& drawing, const GearGeometry& geometry,
                    const ContactPath& path, const GearBases& bases, GearTarget* target);

}  // namespace gearsweep
