// Contour lines of a map.
#pragma once

#include <string>
#include <vector>

#include "plot/detail/picture.hpp"
#include "plot/detail/scale.hpp"

namespace gearsweep {

// A straight piece of a contour line, in the axes' values.
struct ContourPiece {
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
};

// Between the values of a map of two axes, linear from one to the next (on a logarithmic axis, in
// the logarithm). None beside a point without a value.
std::vector<ContourPiece> contour_pieces(const ResultMap& map, double level);

// All pieces of a level.
struct Contour {
  double level = 0.0;
  std::vector<ContourPiece> pieces;
};

// Further elements of "plot": black lines with a white rim, which are seen on any colour.
std::string add_contours(const std::vector<Contour>& contours, PlotScript* script);

// "set label" lines: each level once, on a white ground, where its line is far from the frame and
// from other labels; none of a line that has no such place.
std::string contour_labels(const Page& page, const std::vector<Contour>& contours,
                           const AxisRange& x, const AxisRange& y);

// The levels that were asked for, or so many evenly within the range,
// of logarithmic colours in the logarithm.
std::vector<double> contour_levels(const Contours& contours, const ValueRange& range, bool is_log);

}  // namespace gearsweep
