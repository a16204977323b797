// One axis: a curve, or dots at the classes.
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

std::string curve(const ResultMap& map, const std::string& data) {
  // So few points that each of them should be seen.
  constexpr std::size_t kFew = 60;
  const ValueRange range = padded_range(map.values);
  return fmt::format(
      "set yrange [{}:{}]\n"
      "plot {} using 1:2 with {} linewidth 1.5 linecolor rgb '#0072b2' notitle",
      range.least, range.greatest, data,
      map.points() <= kFew ? "linespoints pointtype 7 pointsize 0.7" : "lines");
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
  for (std::size_t i = 0; i < map.points(); ++i) {
    const double value = std::isfinite(map.values[i]) ? map.values[i] : std::nan("");
    append_numbers({map.axes[0].values[i], classes ? classes->index_of(value) : value},
                   &script.data);
  }
  const std::string data =
      fmt::format("files.'.dat' binary record=({}) format='%double%double'", map.points());
  script.text += classes ? class_dots(*classes, data) : curve(map, data);
  script.text += missing_marks(picture) + "\n";
  script.missing = missing_places(picture);
  return script;
}

}  // namespace gearsweep
