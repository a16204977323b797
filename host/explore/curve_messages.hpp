// What the explorer's server says of bifurcation curves: JSON.
#pragma once

#include <string>

#include "explore/explorer.hpp"

namespace gearsweep {

// The parameters, how each kind that there is is drawn, and the curves: kind, period, places, and
// the stretches [first, last, stable] that they are drawn by.
std::string curves_message(const ExploredCurves& curves);

// As motion_message(), with what the file tells of the point in the place of quantities.
std::string border_message(const Explorer& explorer, const Scene& scene,
                           const BorderMotion& border);

}  // namespace gearsweep
