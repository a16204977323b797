// Contour lines of a map.
#pragma once

#include <vector>

#include "plot/detail/scale.hpp"

namespace gearsweep {

// A straight piece of a contour line, in the axes' values.
struct ContourPiece {
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
};

// Between the values of a map of two axes, linear from one to the next (on a logarithmic axis, in
// the logarithm). None beside a point without a value.
std::vector<ContourPiece> contour_pieces(const ResultMap& map, double level);

// The levels that were asked for, or so many evenly within the range,
// of logarithmic colours in the logarithm.
std::vector<double> contour_levels(const Contours& contours, const ValueRange& range, bool is_log);

}  // namespace gearsweep
