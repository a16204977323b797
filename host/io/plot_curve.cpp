// One axis: curves, or dots at the classes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "io/plot_picture.hpp"
#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

std::string class_dots(const ClassScale& classes, const std::string& data) {
  std::vector<std::string> tics;
  for (std::size_t i = 0; i < classes.names.size(); ++i) {
    tics.push_back(fmt::format("{} {}", quote(literal(classes.names[i])), i));
  }
  return fmt::format(
      "{}unset colorbox\nset yrange [-0.5:{}-0.5]\nset ytics ({})\n"
      "plot {} using 1:2:2 with points pointtype 7 pointsize 0.6 linecolor palette notitle",
      classes.palette(), classes.names.size(), fmt::join(tics, ", "), data);
}

// The first curve, over the others: of Lyapunov exponents the one that tells chaos.
std::string curves(const ResultMap& map, const std::string& data) {
  // So few points that each of them should be seen.
  constexpr std::size_t kFew = 60;
  const std::string style =
      map.points() <= kFew ? "linespoints pointtype 7 pointsize 0.7" : "lines";
  const ValueRange range = padded_range(map.values);
  std::string text = fmt::format("set yrange [{}:{}]\n", range.least, range.greatest);
  if (range.least < 0.0 && range.greatest > 0.0) {
    text += "set xzeroaxis linetype 1 linewidth 1 linecolor rgb '#777777'\n";
  }
  text += "plot ";
  const std::size_t count = map.part_count();
  for (std::size_t part = count; part > 1; --part) {
    const std::string title = part == count ? fmt::format("{} 2 to {}", map.dimension, count) : "";
    text +=
        fmt::format("{} using 1:{} with {} linewidth 1 linecolor rgb '#56b4e9' title {}, \\\n     ",
                    data, part + 1, style, quote(literal(title)));
  }
  const std::string title = count > 1 ? fmt::format("{} 1", map.dimension) : "";
  return text + fmt::format("{} using 1:2 with {} linewidth 1.5 linecolor rgb '{}' title {}", data,
                            style, count > 1 ? "#d55e00" : "#0072b2", quote(literal(title)));
}

}  // namespace

PlotScript draw_curve(const Picture& picture) {
  const ResultMap& map = picture.map;
  PlotScript script;
  script.text = frame(picture) + axis_lines('x', map.axes[0]) +
                fmt::format(
                    "set ylabel {}\nset y2range [0:1]\n"
                    "set grid linetype 1 linewidth 0.6 linecolor rgb '#dddddd'\n",
                    quote(label_of(map.name, map.unit)));
  std::optional<ClassScale> classes;
  if (!map.flags.empty()) classes = class_scale(map);
  const std::size_t parts = map.part_count();
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (i % parts == 0) append_numbers({map.axes[0].values[i / parts]}, &script.data);
    const double value = std::isfinite(map.values[i]) ? map.values[i] : std::nan("");
    append_numbers({classes ? classes->index_of(value) : value}, &script.data);
  }
  const std::string data =
      fmt::format("files.'.dat' binary record=({}) format='%{}double'", map.points(), parts + 1);
  script.text += classes ? class_dots(*classes, data) : curves(map, data);
  script.text += missing_marks(picture) + "\n";
  script.missing = missing_places(picture);
  return script;
}

}  // namespace gearsweep
