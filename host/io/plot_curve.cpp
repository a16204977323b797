// One axis: curves, or dots at the classes.
#include <fmt/format.h>

#include <cmath>

#include "io/plot_picture.hpp"
#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

constexpr const char *kOnlyPart = "#0072b2", *kFirstPart = "#d55e00", *kOtherParts = "#56b4e9";

std::string class_dots(const ClassScale& classes, const std::string& data) {
  return fmt::format(
      "{}unset colorbox\n{}plot {} using 1:2:2 with points pointtype 7 pointsize 0.6 linecolor "
      "palette notitle",
      classes.palette(), classes.tics(), data);
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
  for (std::size_t part = map.part_count(); part > 1; --part) {
    text += fmt::format("{} using 1:{} with {} linewidth 1 linecolor rgb '{}' notitle, \\\n     ",
                        data, part + 1, style, kOtherParts);
  }
  return text + fmt::format("{} using 1:2 with {} linewidth 1.5 linecolor rgb '{}' notitle", data,
                            style, map.part_count() > 1 ? kFirstPart : kOnlyPart);
}

}  // namespace

std::vector<std::string> part_entries(const ResultMap& map) {
  if (map.part_count() == 1) return {};
  const auto entry = [&](const char* colour, const std::string& parts) {
    return fmt::format("keyentry with lines linewidth 1.5 linecolor rgb '{}' title {}", colour,
                       quote(literal(fmt::format("{} {}", map.dimension, parts))));
  };
  return {entry(kFirstPart, "1"), entry(kOtherParts, fmt::format("2 to {}", map.part_count()))};
}

void add_curve(const Picture& picture, const std::string& label, PlotScript* script) {
  const ResultMap& map = picture.map;
  script->text += fmt::format(
      "set ylabel {}\nset y2range [0:1]\n"
      "set grid linetype 1 linewidth 0.6 linecolor rgb '#dddddd'\n",
      quote(label));
  std::optional<ClassScale> classes;
  if (!map.flags.empty()) classes = class_scale(map);
  const std::size_t parts = map.part_count();
  const std::string data = next_records(*script, map.points(), parts + 1);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (i % parts == 0) append_numbers({map.axes[0].values[i / parts]}, &script->data);
    const double value = std::isfinite(map.values[i]) ? map.values[i] : std::nan("");
    append_numbers({classes ? classes->index_of(value) : value}, &script->data);
  }
  script->text += classes ? class_dots(*classes, data) : curves(map, data);
  add_missing_marks(picture, kMissingColour, script);
}

PlotScript draw_curve(const Picture& picture) {
  const ResultMap& map = picture.map;
  PlotScript script;
  script.text = frame(picture) + axis_lines('x', map.axes[0]);
  add_curve(picture, label_of(map.name, map.unit), &script);
  for (const std::string& entry : part_entries(map)) script.text += ", \\\n     " + entry;
  script.text += "\n";
  return script;
}

}  // namespace gearsweep
