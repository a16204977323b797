#include "plot/detail/density.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/detail/raster.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kColumns = 480, kRows = 360;

// How often each cell is passed through, row by row from the lowest.
class Counts {
 public:
  // A line between two points, in cells. One cell counts once for a line.
  void add_line(double x1, double y1, double x2, double y2) {
    const double length = std::max(std::abs(x2 - x1), std::abs(y2 - y1));
    if (!std::isfinite(length) || length > 4.0 * static_cast<double>(kColumns + kRows)) return;
    const auto steps = static_cast<std::size_t>(std::ceil(length)) + 1;
    std::size_t last = counts_.size();
    for (std::size_t i = 0; i < steps; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(steps);
      const std::size_t cell = cell_at(x1 + share * (x2 - x1), y1 + share * (y2 - y1));
      if (cell < counts_.size() && cell != last) counts_[cell] += 1.0;
      last = cell;
    }
  }
  const std::vector<double>& values() const { return counts_; }

 private:
  std::size_t cell_at(double x, double y) const {
    const bool is_inside =
        x >= 0.0 && y >= 0.0 && x < static_cast<double>(kColumns) && y < static_cast<double>(kRows);
    if (!is_inside) return counts_.size();
    return static_cast<std::size_t>(y) * kColumns + static_cast<std::size_t>(x);
  }

  std::vector<double> counts_ = std::vector<double>(kColumns * kRows, 0.0);
};

}  // namespace

std::string density_lines() {
  return fmt::format(
      "unset colorbox\nset palette defined (0 '#c6dbef', 0.5 '#4292c6', 1 '{}')\n"
      "set cbrange [0:1]\n",
      kDensestColour);
}

std::string add_density(const std::vector<double>& x, const std::vector<double>& y,
                        const AxisRange& x_range, const AxisRange& y_range, PlotScript* script) {
  Counts counts;
  const auto column = [&](double value) {
    return (value - x_range.min) / (x_range.max - x_range.min) * static_cast<double>(kColumns);
  };
  const auto row = [&](double value) {
    return (value - y_range.min) / (y_range.max - y_range.min) * static_cast<double>(kRows);
  };
  for (std::size_t i = 1; i < x.size(); ++i) {
    counts.add_line(column(x[i - 1]), row(y[i - 1]), column(x[i]), row(y[i]));
  }
  const double most = *std::ranges::max_element(counts.values());
  Raster raster;
  raster.columns = kColumns;
  raster.rows = kRows;
  for (const double count : counts.values()) {
    raster.values.push_back(count > 0.0 ? std::log1p(count) / std::log1p(most) : std::nan(""));
  }
  return add_image(raster, "x2y2", script);
}

}  // namespace gearsweep
