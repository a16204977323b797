// Poincare samples over one axis: dots, or the density of the samples where there are too many.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/plot_picture.hpp"
#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

// How many samples of each point fall in each of `bins` equal parts of the range: [bin][point].
std::vector<double> histogram(const ResultMap& map, const ValueRange& range, std::size_t bins) {
  const std::size_t points = map.points();
  std::vector<double> counts(bins * points, 0.0);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (!std::isfinite(map.values[i])) continue;
    const double part = (map.values[i] - range.least) / (range.greatest - range.least);
    // Also where the range is beyond all numbers, and the part of it none.
    const double place = std::max(0.0, part * static_cast<double>(bins));
    const std::size_t bin = std::min(static_cast<std::size_t>(place), bins - 1);
    counts[bin * points + i / map.samples] += 1.0;
  }
  return counts;
}

void draw_density(const ResultMap& map, const ValueRange& range, PlotScript* script) {
  // About one bin for each pixel of the picture's height.
  constexpr std::size_t kBins = 700;
  const auto per_point = static_cast<double>(map.samples);
  for (const double count : histogram(map, range, kBins)) {
    append_numbers({count > 0.0 ? count / per_point : std::nan("")}, &script->data);
  }
  const std::vector<double> edges = cell_edges(map.axes[0]);
  const double step = (range.greatest - range.least) / static_cast<double>(kBins);
  script->text += fmt::format(
      "set palette defined (0 '#8fb4d9', 0.35 '#3690c0', 0.7 '#034e7b', 1 '#01121f')\n"
      "set logscale cb\nset cbrange [{}:1]\nset cblabel 'share of the samples'\n"
      "plot files.'.dat' binary array=({},{}) origin=({},{}) dx={} dy={} "
      "format='%double' using 1 with image notitle",
      1.0 / per_point, map.points(), kBins, map.axes[0].values.front(), range.least + 0.5 * step,
      (edges.back() - edges.front()) / static_cast<double>(map.points()), step);
}

}  // namespace

void add_dots(const ResultMap& map, const ValueRange& range, const std::string& colour,
              PlotScript* script) {
  // Samples that would fall on the same dot are drawn once.
  constexpr std::size_t kBins = 4000;
  constexpr std::size_t kFewDots = 3000;  // they must be seen one by one
  const std::vector<double> counts = histogram(map, range, kBins);
  const double step = (range.greatest - range.least) / static_cast<double>(kBins);
  const auto dots = static_cast<std::size_t>(
      std::count_if(counts.begin(), counts.end(), [](double count) { return count > 0.0; }));
  script->text +=
      fmt::format("{} using 1:2 with points pointtype 7 pointsize {} linecolor rgb '{}' notitle",
                  next_records(*script, dots, 2), dots < kFewDots ? 0.7 : 0.25, colour);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] <= 0.0) continue;
    const std::size_t bin = i / map.points();
    const double middle = range.least + (static_cast<double>(bin) + 0.5) * step;
    append_numbers({map.axes[0].values[i % map.points()], middle}, &script->data);
  }
}

PlotScript draw_bifurcation(const Picture& picture) {
  const ResultMap& map = picture.map;
  const ValueRange range = padded_range(map.values);
  const ChannelInfo& state = map.parts.front();
  PlotScript script;
  script.text = frame(picture) + axis_lines('x', map.axes[0]) +
                fmt::format("set ylabel {}\nset yrange [{}:{}]\nset y2range [0:1]\n",
                            quote(label_of(state.name, state.unit)), range.least, range.greatest);
  constexpr std::size_t kManySamples = 20000;
  // Columns of an image with fewer points would be bars, not a diagram.
  constexpr std::size_t kManyPoints = 150;
  if (map.values.size() > kManySamples && map.points() >= kManyPoints && is_even(map.axes[0])) {
    draw_density(map, range, &script);
  } else {
    script.text += "plot ";
    add_dots(map, range, "#01325a", &script);
  }
  add_missing_marks(picture, kMissingColour, &script);
  script.text += "\n";
  return script;
}

}  // namespace gearsweep
