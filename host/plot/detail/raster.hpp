// Maps as images: of pixels, so that no seam shows between cells.
#pragma once

#include <string>
#include <vector>

#include "plot/detail/picture.hpp"

namespace gearsweep {

// Numbers for an image, row by row from the lowest; what is not a number is transparent.
struct Raster {
  std::size_t columns = 0, rows = 0;
  std::vector<double> values;
};

// A map over two axes as it stands between these ends. shades: of its points.
Raster raster_of(const Page& page, const ResultMap& map, const std::vector<double>& shades,
                 const AxisRange& x, const AxisRange& y);

// An element of "plot" that fills these axes, "x1y1" or "x2y2", which go from 0 to 1.
std::string add_image(const Raster& raster, const std::string& axes, PlotScript* script);

}  // namespace gearsweep
