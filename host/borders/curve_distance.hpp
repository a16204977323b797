// How far curves are from places of a map, in its pixels.
#pragma once

#include <array>
#include <vector>

#include "borders/border_curve.hpp"
#include "borders/map_borders.hpp"

namespace gearsweep {

using PixelPlace = std::array<double, 2>;  // columns and rows, 0 at the first pixel's middle

PixelPlace pixel_place(const PeriodPixels& pixels, const PlanePlace& place);
// The middle of an edge.
PixelPlace middle_of(const PeriodPixels& pixels, const BorderEdge& edge);
// The line through a curve's points.
class PixelLine {
 public:
  PixelLine(const PeriodPixels& pixels, const BorderCurve& curve);

  // of_stable: from those parts of it alone where a stable motion bifurcates, which are what a map
  // shows. Infinite where there are none.
  double distance_to(const PixelPlace& place, bool of_stable = false) const;

 private:
  std::vector<PixelPlace> places_;
  std::vector<bool> is_stable_;  // [place]
};

}  // namespace gearsweep
