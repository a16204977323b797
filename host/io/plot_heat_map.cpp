// Two axes: an image where the grid is even, else one box per point.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/plot_picture.hpp"
#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

// Values as they are coloured: classes by their index.
std::vector<double> shades_of(const ResultMap& map, const std::optional<ClassScale>& classes) {
  std::vector<double> shades = map.values;
  for (double& shade : shades) {
    if (!std::isfinite(shade)) shade = std::nan("");
    if (classes) shade = classes->index_of(shade);
  }
  return shades;
}

// The colour bar. The margin counts in letters of mean width: bar and label, and the tics.
std::string colour_lines(const ResultMap& map, const std::optional<ClassScale>& classes) {
  std::string label = label_of(map.name, map.unit);
  std::string lines;
  std::size_t longest_tic = 6;
  if (classes) {
    for (const std::string& name : classes->names) longest_tic = std::max(longest_tic, name.size());
    lines = classes->palette();
  } else {
    const ValueRange range = colour_range(map.values);
    if (range.clipped) label += " (colours cover 99.8 % of the points)";
    const bool diverging =
        map.name.starts_with("lyapunov") && range.least < 0.0 && range.greatest > 0.0;
    lines = fmt::format(
        "{}set cbrange [{}:{}]\n",
        diverging ? diverging_palette(range.least, range.greatest) : sequential_palette(),
        range.least, range.greatest);
  }
  // Tics without marks stand closer to the label than gnuplot reckons.
  return fmt::format("set cblabel {} offset {},0\n{}set rmargin {}\n", quote(label),
                     classes ? 1 : 0, lines, (classes ? 8 : 7) + longest_tic / 2);
}

// Where the pixels are: their middles and steps.
std::string image_place(const ResultMap& map) {
  const auto step = [](const ResultAxis& axis) {
    const std::vector<double> edges = cell_edges(axis);
    return (edges.back() - edges.front()) / static_cast<double>(axis.values.size());
  };
  const ResultAxis& x = map.axes[0];
  const ResultAxis& y = map.axes[1];
  return fmt::format("array=({},{}) origin=({},{}) dx={} dy={}", x.values.size(), y.values.size(),
                     x.values.front(), y.values.front(), step(x), step(y));
}

// Pixels that are not a number stay transparent.
void draw_image(const ResultMap& map, const std::vector<double>& shades, PlotScript* script) {
  for (const double shade : shades) append_numbers({shade}, &script->data);
  script->text += fmt::format(
      "plot files.'.dat' binary {} format='%double' using 1 with image notitle", image_place(map));
}

// The cells of a grid as boxes. Where boxes only touch, a bright seam shows, so each reaches below
// the next ones, which are drawn over it, but not below a cell without a value.
class Boxes {
 public:
  Boxes(const ResultMap& map, const std::vector<double>& shades)
      : map_(map), shades_(shades), x_(cell_edges(map.axes[0])), y_(cell_edges(map.axes[1])) {}

  // Appends x, y, x least, x greatest, y least, y greatest, shade of each box; returns how many.
  std::size_t append_all(std::string* data) const {
    std::size_t count = 0;
    for (std::size_t iy = 0; iy < map_.axes[1].values.size(); ++iy) {
      for (std::size_t ix = 0; ix < map_.axes[0].values.size(); ++ix) {
        if (!is_there(ix, iy)) continue;
        const bool right = is_there(ix + 1, iy);
        const bool up = is_there(ix, iy + 1) && (!right || is_there(ix + 1, iy + 1));
        append_numbers({map_.axes[0].values[ix], map_.axes[1].values[iy], x_[ix],
                        far_edge(x_, ix, right), y_[iy], far_edge(y_, iy, up), shade(ix, iy)},
                       data);
        ++count;
      }
    }
    return count;
  }

 private:
  double shade(std::size_t ix, std::size_t iy) const {
    return shades_[iy * map_.axes[0].values.size() + ix];
  }
  bool is_there(std::size_t ix, std::size_t iy) const {
    return ix < map_.axes[0].values.size() && iy < map_.axes[1].values.size() &&
           !std::isnan(shade(ix, iy));
  }
  static double far_edge(const std::vector<double>& edges, std::size_t i, bool reaches) {
    return reaches ? 0.5 * (edges[i + 1] + edges[i + 2]) : edges[i + 1];
  }

  const ResultMap& map_;
  const std::vector<double>& shades_;
  std::vector<double> x_, y_;  // edges
};

void draw_boxes(const ResultMap& map, const std::vector<double>& shades, PlotScript* script) {
  const std::size_t count = Boxes(map, shades).append_all(&script->data);
  script->text += "set style fill solid 1 noborder\nplot ";
  if (count == 0) {
    // gnuplot takes no empty file.
    script->text += "NaN notitle";
    return;
  }
  script->text += fmt::format(
      "files.'.dat' binary record=({}) format='%7double' using 1:2:3:4:5:6:7 \\\n"
      "     with boxxyerror linecolor palette notitle",
      count);
}

// Points without a value are where the grey ground shows.
std::string missing_ground(const Picture& picture) {
  if (picture.missing.note.empty()) return "";
  return fmt::format(
      "set object rectangle from graph 0, graph 0 to graph 1, graph 1 behind fillstyle solid 1 "
      "noborder fillcolor rgb '{}'\n",
      kMissingColour);
}

}  // namespace

PlotScript draw_heat_map(const Picture& picture) {
  const ResultMap& map = picture.map;
  const std::optional<ClassScale> classes = class_scale(map);
  PlotScript script;
  script.text = frame(picture) + axis_lines('x', map.axes[0]) + axis_lines('y', map.axes[1]) +
                colour_lines(map, classes) + missing_ground(picture);
  const std::vector<double> shades = shades_of(map, classes);
  if (is_even(map.axes[0]) && is_even(map.axes[1])) {
    draw_image(map, shades, &script);
  } else {
    draw_boxes(map, shades, &script);
  }
  if (!picture.missing.note.empty()) {
    script.text += fmt::format(
        ", \\\n     keyentry with boxes fillstyle solid 1 noborder linecolor rgb '{}' title {}",
        kMissingColour, quote(literal(picture.missing.note)));
  }
  script.text += "\n";
  return script;
}

}  // namespace gearsweep
