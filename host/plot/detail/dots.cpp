#include "plot/detail/dots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

constexpr double kDiameter = 0.7;  // points

// How much of a dot is seen, from 0 to 1, so that samples that spread evenly over the panel's width
// and half of its height make this shade.
double opacity(std::size_t samples, const Frame& frame, double diameter, double shade) {
  constexpr double kFaintest = 0.02, kSpread = 0.5;
  constexpr double kArea = 0.785;  // of a circle in its square
  const double layers = static_cast<double>(samples) * kArea * diameter * diameter /
                        (kSpread * frame.width() * frame.height());
  return std::clamp(1.0 - std::pow(1.0 - shade, 1.0 / std::max(layers, 1e-3)), kFaintest, 1.0);
}

std::size_t append_samples(const ResultMap& map, std::string* data) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (!std::isfinite(map.values[i])) continue;
    append_numbers({map.axes.front().values[i / map.samples], map.values[i]}, data);
    ++count;
  }
  return count;
}

std::string axes_of_raster(const AxisRange& x, const AxisRange& y) {
  std::string text =
      fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", x.min, x.max, y.min, y.max);
  if (x.logarithmic) text += "set logscale x\n";
  if (y.logarithmic) text += "set logscale y\n";
  return text;
}

}  // namespace

std::string add_dots(const Page& page, const std::vector<Picture>& layers, const AxisRange& x,
                     const AxisRange& y, const Frame& frame, std::size_t number,
                     PlotScript* script) {
  std::vector<std::string> elements;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const ResultMap& map = layers[i].map;
    // Few dots must be seen one by one.
    constexpr std::size_t kFew = 3000;
    const double larger = map.values.size() < kFew ? 1.8 : 1.0;
    const double diameter =
        kDiameter * larger * (1.0 + 1.0 * static_cast<double>(layers.size() - 1 - i));
    const double transparency =
        255.0 * (1.0 - opacity(map.values.size(), frame, diameter, i == 0 ? 0.55 : 0.35));
    std::string* data = &script->data;
    const std::size_t skip = data->size();
    const std::size_t count = append_samples(map, data);
    if (count == 0) continue;
    elements.push_back(
        fmt::format("data binary record=({}) skip={} format='%2double' using 1:2 \\\n     with "
                    "points pointtype 7 "
                    "pointsize dot*{:.3g} linewidth 0.2 linecolor rgb '#{:02x}{}' notitle",
                    count, skip, diameter / 2.0, static_cast<int>(transparency),
                    dot_colour(i, layers.size()).substr(1)));
  }
  if (elements.empty()) return "NaN notitle";
  const std::string dots = fmt::format("{}", fmt::join(elements, ", \\\n     "));
  if (page.is_raster()) return dots;
  script->before += fmt::format(
      "{0}set output files.'-dots{1}.png'\nreset\nunset key\nunset border\nunset tics\n"
      "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\n"
      "set tmargin at screen 1\n{2}plot {3}\nunset output\n",
      page.raster_terminal(frame), number, axes_of_raster(x, y), dots);
  const auto [columns, rows] = page.raster_size(frame);
  const double dx = 1.0 / static_cast<double>(columns), dy = 1.0 / static_cast<double>(rows);
  return fmt::format(
      "files.'-dots{}.png' binary filetype=png origin=({},{}) dx={} dy={} axes x2y2 \\\n"
      "     with rgbimage notitle",
      number, 0.5 * dx, 0.5 * dy, dx, dy);
}

}  // namespace gearsweep
