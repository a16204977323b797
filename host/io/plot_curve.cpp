// One axis: a curve, or dots and steps between classes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "io/plot_picture.hpp"
#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

std::string class_lines(const ClassScale& classes) {
  std::vector<std::string> tics;
  for (std::size_t i = 0; i < classes.names.size(); ++i) {
    tics.push_back(fmt::format("{} {}", quote(literal(classes.names[i])), i));
  }
  return fmt::format("{}set yrange [-0.5:{}-0.5]\nset ytics ({})\nunset colorbox\n",
                     classes.palette(), classes.names.size(), fmt::join(tics, ", "));
}

}  // namespace

PlotScript draw_curve(const Picture& picture) {
  const ResultMap& map = picture.map;
  const std::size_t points = map.points();
  PlotScript script;
  script.text = frame(picture) + axis_lines('x', map.axes[0]) +
                fmt::format("set ylabel {}\nset y2range [0:1]\nset grid linecolor rgb '#dddddd'\n",
                            quote(label_of(map.name, map.unit)));
  std::optional<ClassScale> classes;
  if (!map.flags.empty()) classes = class_scale(map);
  for (std::size_t i = 0; i < points; ++i) {
    const double value = std::isfinite(map.values[i]) ? map.values[i] : std::nan("");
    append_numbers({map.axes[0].values[i], classes ? classes->index_of(value) : value},
                   &script.data);
  }
  const std::string data =
      fmt::format("files.'.dat' binary record=({}) format='%double%double' using ", points);
  if (classes) {
    script.text +=
        class_lines(*classes) + fmt::format(
                                    "plot {0}1:2 with histeps linecolor rgb '#bbbbbb' notitle, \\\n"
                                    "     {0}1:2:2 with points pointtype 7 pointsize 0.5 "
                                    "linecolor palette notitle",
                                    data);
  } else {
    // So few points that each of them should be seen.
    constexpr std::size_t kFew = 60;
    script.text += fmt::format(
        "set offsets 0, 0, graph 0.05, graph 0.05\nplot {}1:2 with {} "
        "linewidth 1.5 linecolor rgb '#0072b2' notitle",
        data, points <= kFew ? "linespoints pointtype 7 pointsize 0.7" : "lines");
  }
  script.text += missing_marks(picture) + "\n";
  script.missing = missing_places(picture);
  return script;
}

}  // namespace gearsweep
