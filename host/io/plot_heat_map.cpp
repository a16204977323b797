// Two axes: an image where the grid is even, else one box per point.
#include <fmt/format.h>

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

std::string colour_lines(const ResultMap& map, const std::optional<ClassScale>& classes) {
  if (classes)
    return fmt::format("set cblabel {}\n", quote(label_of(map.name, map.unit))) +
           classes->palette();
  const ColourRange range = colour_range(map.values);
  const std::string clipped = range.clipped ? ", colours cover 99.8 % of the points" : "";
  return fmt::format("set cblabel {}\n{}set cbrange [{}:{}]\n",
                     quote(label_of(map.name, map.unit) + clipped), sequential_palette(),
                     range.least, range.greatest);
}

std::string image_place(const ResultMap& map) {
  const auto origin = [](const ResultAxis& axis) { return axis.values.front(); };
  const auto step = [](const ResultAxis& axis) {
    const std::vector<double> edges = cell_edges(axis);
    return (edges.back() - edges.front()) / static_cast<double>(axis.values.size());
  };
  const ResultAxis& x = map.axes[0];
  const ResultAxis& y = map.axes[1];
  return fmt::format("array=({},{}) origin=({},{}) dx={} dy={}", x.values.size(), y.values.size(),
                     origin(x), origin(y), step(x), step(y));
}

void draw_image(const Picture& picture, const std::vector<double>& shades, PlotScript* script) {
  const std::string place = image_place(picture.map);
  for (const double shade : shades) append_numbers({shade}, &script->data);
  script->text +=
      fmt::format("plot files.'.dat' binary {} format='%double' using 1 with image notitle", place);
  if (picture.missing.note.empty()) return;
  for (const bool missing : picture.missing.mask) {
    // Grey of the missing colour, opaque or transparent.
    script->missing += missing ? std::string("\xb3\xb3\xb3\xff") : std::string(4, '\0');
  }
  script->text += fmt::format(
      ", \\\n     files.'-missing.dat' binary {} format='%uchar%uchar%uchar%uchar' using 1:2:3:4 "
      "with rgbalpha notitle",
      place);
}

void draw_boxes(const Picture& picture, const std::vector<double>& shades, PlotScript* script) {
  const std::vector<double> x = cell_edges(picture.map.axes[0]);
  const std::vector<double> y = cell_edges(picture.map.axes[1]);
  std::size_t drawn = 0, missing = 0;
  // Where boxes only touch, a bright seam shows. Each reaches below the next ones, which are drawn
  // over it.
  const auto reach = [](const std::vector<double>& edges, std::size_t i) {
    return i + 2 < edges.size() ? 0.5 * (edges[i + 1] + edges[i + 2]) : edges[i + 1];
  };
  for (std::size_t point = 0; point < shades.size(); ++point) {
    const std::size_t ix = point % (x.size() - 1);
    const std::size_t iy = point / (x.size() - 1);
    const double middle_x = picture.map.axes[0].values[ix];
    const double middle_y = picture.map.axes[1].values[iy];
    if (picture.missing.mask[point]) {
      append_numbers({middle_x, middle_y, x[ix], x[ix + 1], y[iy], y[iy + 1]}, &script->missing);
      ++missing;
    } else {
      append_numbers({middle_x, middle_y, x[ix], reach(x, ix), y[iy], reach(y, iy), shades[point]},
                     &script->data);
      ++drawn;
    }
  }
  script->text += "set style fill solid 1 noborder\nplot ";
  if (drawn > 0) {
    script->text += fmt::format(
        "files.'.dat' binary record=({}) format='%7double' using 1:2:3:4:5:6:7 \\\n"
        "     with boxxyerror linecolor palette notitle",
        drawn);
  }
  if (missing > 0) {
    script->text += fmt::format(
        "{}files.'-missing.dat' binary record=({}) format='%6double' using 1:2:3:4:5:6 \\\n"
        "     with boxxyerror linecolor rgb '{}' notitle",
        drawn > 0 ? ", \\\n     " : "", missing, kMissingColour);
  }
}

}  // namespace

PlotScript draw_heat_map(const Picture& picture) {
  const ResultMap& map = picture.map;
  const std::optional<ClassScale> classes = class_scale(map);
  PlotScript script;
  script.text = frame(picture) + axis_lines('x', map.axes[0]) + axis_lines('y', map.axes[1]) +
                colour_lines(map, classes);
  const std::vector<double> shades = shades_of(map, classes);
  if (is_even(map.axes[0]) && is_even(map.axes[1])) {
    draw_image(picture, shades, &script);
  } else {
    draw_boxes(picture, shades, &script);
  }
  if (!picture.missing.note.empty()) {
    script.text += fmt::format(
        ", \\\n     keyentry with boxes fillstyle solid 1 noborder "
        "linecolor rgb '{}' title {}",
        kMissingColour, quote(literal(picture.missing.note)));
  }
  script.text += "\n";
  return script;
}

}  // namespace gearsweep
