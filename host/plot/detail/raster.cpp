#include "plot/detail/raster.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

// Where the pixels' middles lie on an axis: which cell is there. -1: none.
std::vector<std::ptrdiff_t> cells_at(const ResultAxis& axis, const AxisRange& range,
                                     std::size_t pixels) {
  const std::vector<double> edges = cell_edges(axis);
  std::vector<std::ptrdiff_t> cells;
  for (std::size_t i = 0; i < pixels; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(pixels);
    const double place = between(range.min, range.max, share, range.logarithmic);
    const auto above = std::upper_bound(edges.begin(), edges.end(), place);
    const bool is_inside = above != edges.begin() && above != edges.end();
    cells.push_back(is_inside ? above - edges.begin() - 1 : -1);
  }
  return cells;
}

// A pixel for each cell where cells are even on the axis's scale and fill it; else so many that
// their edges are near enough.
std::size_t pixels_of(const ResultAxis& axis, const AxisRange& range, std::size_t fine) {
  const std::size_t count = axis.values.size();
  const std::vector<std::ptrdiff_t> cells = cells_at(axis, range, count);
  bool is_even = count > 1;
  for (std::size_t i = 0; i < count && is_even; ++i) {
    is_even = cells[i] == static_cast<std::ptrdiff_t>(i);
  }
  const std::vector<double> edges = cell_edges(axis);
  const bool is_whole = edges.front() == range.min && edges.back() == range.max;
  // Uneven cells may have their pixels' middles right by chance.
  const auto place = [&](double value) { return range.logarithmic ? std::log(value) : value; };
  const double step = (place(edges.back()) - place(edges.front())) / static_cast<double>(count);
  for (std::size_t i = 0; i < edges.size() && is_even; ++i) {
    const double even = place(edges.front()) + static_cast<double>(i) * step;
    is_even = std::abs(place(edges[i]) - even) < 0.02 * step;
  }
  return is_even && is_whole ? count : std::max<std::size_t>(2, fine);
}

// Viewers of vector formats smooth what they enlarge, so there each cell has several pixels.
std::size_t enlarged(const Page& page, std::size_t cells, std::size_t fine) {
  return page.is_raster() || cells >= fine ? cells : cells * ((fine + cells - 1) / cells);
}

}  // namespace

Raster raster_of(const Page& page, const ResultMap& map, const std::vector<double>& shades,
                 const AxisRange& x, const AxisRange& y) {
  constexpr std::size_t kFineColumns = 1000, kFineRows = 800;
  Raster raster;
  constexpr std::size_t kSharpColumns = 600, kSharpRows = 450;
  raster.columns = enlarged(page, pixels_of(map.axes[0], x, kFineColumns), kSharpColumns);
  raster.rows = enlarged(page, pixels_of(map.axes[1], y, kFineRows), kSharpRows);
  const std::vector<std::ptrdiff_t> columns = cells_at(map.axes[0], x, raster.columns);
  const std::vector<std::ptrdiff_t> rows = cells_at(map.axes[1], y, raster.rows);
  const auto width = static_cast<std::ptrdiff_t>(map.axes[0].values.size());
  for (const std::ptrdiff_t row : rows) {
    for (const std::ptrdiff_t column : columns) {
      const bool is_inside = row >= 0 && column >= 0;
      raster.values.push_back(is_inside ? shades[static_cast<std::size_t>(row * width + column)]
                                        : std::nan(""));
    }
  }
  return raster;
}

std::string add_image(const Raster& raster, const std::string& axes, PlotScript* script) {
  const double dx = 1.0 / static_cast<double>(raster.columns);
  const double dy = 1.0 / static_cast<double>(raster.rows);
  const std::string text = fmt::format(
      "data binary array=({},{}) skip={} origin=({},{}) dx={} dy={} format='%double' using 1 "
      "axes {} \\\n     with image notitle",
      raster.columns, raster.rows, script->data.size(), 0.5 * dx, 0.5 * dy, dx, dy, axes);
  for (const double value : raster.values) append_numbers({value}, &script->data);
  return text;
}

}  // namespace gearsweep
