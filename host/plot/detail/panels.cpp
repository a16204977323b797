#include "plot/detail/panels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "plot/band.hpp"
#include "plot/detail/dots.hpp"
#include "plot/detail/text.hpp"
#include "result/hysteresis.hpp"

namespace gearsweep {
namespace {

// For a list of points, whose neighbours have nothing in common.
constexpr const char* kListDots = "points pointtype 7 pointsize dot*1.2";

// The values of all studies' axes.
ResultAxis whole_axis(const std::vector<Picture>& layers) {
  ResultAxis axis = layers.front().map.axes.front();
  for (const Picture& layer : layers) {
    const std::vector<double>& values = layer.map.axes.front().values;
    axis.values.insert(axis.values.end(), values.begin(), values.end());
  }
  std::sort(axis.values.begin(), axis.values.end());
  axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
  return axis;
}

std::vector<double> all_values(const std::vector<Picture>& layers) {
  std::vector<double> values;
  for (const Picture& layer : layers) {
    values.insert(values.end(), layer.map.values.begin(), layer.map.values.end());
    if (!layer.band) continue;
    for (const ResultMap* end : {&layer.band->low, &layer.band->high}) {
      values.insert(values.end(), end->values.begin(), end->values.end());
    }
  }
  return values;
}

// The classes of all studies.
std::optional<ClassScale> classes_of(const std::vector<Picture>& layers) {
  ResultMap all = layers.front().map;
  if (all.flags.empty() && all.name != "period" && all.name != "attractor_count") return {};
  all.values = all_values(layers);
  return class_scale(all);
}

AxisRange value_range(const Page& page, const std::vector<Picture>& layers, bool is_first) {
  const PlotStyle& style = page.style();
  const std::vector<double> values = all_values(layers);
  const bool is_poincare = layers.front().map.is_poincare();
  if (is_poincare) style.refuse("log", "samples of a state have both signs");
  const bool is_log = style.is_log && !is_poincare;
  const ValueRange range = scale_range(padded_range(values), values,
                                       is_first ? style.yrange : Limits{}, is_log, "--yrange");
  return {range.min, range.max, is_log};
}

// One panel: a quantity of one or several studies.
struct Panel {
  const std::vector<Picture>& layers;
  std::optional<ClassScale> classes;
  PanelAxis y;
  std::string label;                   // markup
  std::optional<std::size_t> upwards;  // as of the stack

  // Where the run-up and the run-down part.
  std::vector<Hysteresis> hystereses() const {
    const bool is_curve = upwards && !classes && layers.front().map.part_count() == 1;
    if (!is_curve || layers.front().map.is_poincare()) return {};
    return find_hysteresis(layers[*upwards].map, layers[1 - *upwards].map);
  }

  Panel(const Page& page, const std::vector<Picture>& pictures, bool is_first)
      : layers(pictures), classes(classes_of(pictures)) {
    const ChannelInfo shown = shown_by(layers.front());
    label = is_first && page.style().ylabel
                ? literal(*page.style().ylabel)
                : quantity_label(shown.name, shown.unit, page.style().words);
    if (!classes) y.range = value_range(page, layers, is_first);
  }
  // Once it stands where it stays.
  const PanelAxis& axis() {
    y.classes = classes ? &*classes : nullptr;
    return y;
  }
};

// The values of a map over its axis, as rows of the script's data.
std::string append_rows(const ResultMap& map, const std::optional<ClassScale>& classes,
                        PlotScript* script) {
  const std::size_t parts = map.part_count();
  const std::string data = next_records(*script, map.points(), parts + 1);
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (i % parts == 0) append_numbers({map.axes.front().values[i / parts]}, &script->data);
    const double value = std::isfinite(map.values[i]) ? map.values[i] : std::nan("");
    append_numbers({classes ? classes->index_of(value) : value}, &script->data);
  }
  return data;
}

// The curve of a run-up or a run-down: triangles, not too many, point where it goes.
std::string directed_style(const ResultMap& map, bool is_upwards) {
  constexpr std::size_t kTriangles = 40;
  return fmt::format("linespoints pointtype {} pointsize dot*1.4 pointinterval {} linewidth 1.6",
                     is_upwards ? 9 : 11, map.points() / kTriangles + 1);
}

// One study's values as a curve, or as dots at its classes.
std::string layer_element(const Panel& panel, std::size_t index, PlotScript* script) {
  const ResultMap& map = panel.layers[index].map;
  const std::string data = append_rows(map, panel.classes, script);
  const std::size_t last = panel.layers.size() - 1;
  if (panel.classes) {
    return fmt::format("{} using 1:2 with points pointtype 7 pointsize dot*{:.3g} {} notitle", data,
                       0.8 + 0.5 * static_cast<double>(last - index),
                       fmt::format("linecolor rgb '{}'", dot_colour(index, last + 1)));
  }
  // So few points that each of them should be seen.
  constexpr std::size_t kFew = 60;
  const std::string style = map.is_list()   ? kListDots
                            : panel.upwards ? directed_style(map, index == *panel.upwards)
                            : map.points() <= kFew
                                ? "linespoints pointtype 7 pointsize dot*1.2 linewidth 2"
                                : "lines linewidth 2";
  return fmt::format("{} using 1:2 with {} {} notitle", data, style, layer_line(index));
}

// The first curve, over the others: of Lyapunov exponents the one that tells chaos.
std::vector<std::string> part_elements(const ResultMap& map, PlotScript* script) {
  const std::string data = append_rows(map, std::nullopt, script);
  std::vector<std::string> elements;
  for (std::size_t part = map.part_count(); part > 0; --part) {
    const std::string style =
        map.is_list() ? kListDots : fmt::format("lines linewidth {}", part == 1 ? 2.0 : 1.4);
    elements.push_back(fmt::format("{} using 1:{} with {} linecolor rgb '{}' notitle", data,
                                   part + 1, style,
                                   part == 1 ? kFirstPartColour : kOtherPartsColour));
  }
  return elements;
}

// Behind a curve: a filled band, and the median as a thin line. Of a list of points, whose
// neighbours have nothing in common, and of a single one, a bar.
std::vector<std::string> band_elements(const CurveBand& band, const AxisRange& y,
                                       PlotScript* script) {
  const std::vector<double>& x = band.low.axes.front().values;
  const std::string data = next_records(*script, x.size(), 4);
  for (std::size_t i = 0; i < x.size(); ++i) {
    // A logarithmic axis has no place for what is below its end.
    const double low = y.logarithmic ? std::max(band.low.values[i], y.min) : band.low.values[i];
    const double median = band.median ? band.median->values[i] : std::nan("");
    append_numbers({x[i], low, band.high.values[i], median}, &script->data);
  }
  const bool has_bars = band.low.is_list() || x.size() == 1;
  std::vector<std::string> elements = {
      has_bars ? fmt::format("{} using 1:2:(0):($3-$2) with vectors nohead linewidth 6 linecolor "
                             "rgb '{}' notitle",
                             data, kBandColour)
               : fmt::format("{} using 1:2:3 with filledcurves fillstyle solid 1 noborder "
                             "linecolor rgb '{}' notitle",
                             data, kBandColour)};
  if (band.median) {
    elements.push_back(fmt::format("{} using 1:4 with {} linecolor rgb '{}' notitle", data,
                                   has_bars ? kListDots : "lines linewidth 1", kMedianColour));
  }
  return elements;
}

// A band where the run-up and the run-down part, and an arrow along each jump.
std::string jump_marks(const Panel& panel) {
  std::string text;
  const auto add_arrow = [&](std::size_t layer, std::size_t from, std::size_t to) {
    const ResultMap& map = panel.layers[layer].map;
    const std::vector<double>& x = map.axes.front().values;
    text += fmt::format(
        "set arrow from first {:.10g}, first {:.10g} to first {:.10g}, first {:.10g} front head "
        "filled size screen 0.015,18 linewidth 2 linecolor rgb '{}'\n",
        x[from], map.values[from], x[to], map.values[to], layer_colour(layer));
  };
  for (const Hysteresis& part : panel.hystereses()) {
    text += fmt::format(
        "set object rectangle from first {:.10g}, graph 0 to first {:.10g}, graph 1 behind "
        "fillstyle solid 1 noborder fillcolor rgb '#eeeeee'\n",
        part.from, part.to);
    if (part.jumps_up) add_arrow(*panel.upwards, part.last, part.last + 1);
    if (part.jumps_down) add_arrow(1 - *panel.upwards, part.first, part.first - 1);
  }
  return text;
}

// Markup of where the jumps are: "run-up jumps at 0.43"; empty where there are none, or too many.
std::string jump_remark(const Panel& panel, const std::vector<std::string>& names) {
  std::vector<std::string> words;
  constexpr std::size_t kMost = 4;
  for (const Hysteresis& part : panel.hystereses()) {
    const auto add = [&](std::size_t layer, double place) {
      words.push_back(fmt::format("{} jumps at {:.4g}", names[layer], place));
    };
    if (part.jumps_up) add(*panel.upwards, part.to);
    if (part.jumps_down) add(1 - *panel.upwards, part.from);
  }
  return words.size() > kMost ? "" : fmt::format("{}", fmt::join(words, "; "));
}

std::vector<std::string> elements_of(const Page& page, const Panel& panel, const AxisRange& x,
                                     const Frame& frame, std::size_t number, PlotScript* script) {
  const ResultMap& first = panel.layers.front().map;
  if (first.is_poincare()) {
    return {add_dots(page, panel.layers, x, panel.y.range, frame, number, script)};
  }
  if (panel.layers.size() == 1 && first.part_count() > 1) return part_elements(first, script);
  std::vector<std::string> elements;
  if (panel.layers.front().band) {
    elements = band_elements(*panel.layers.front().band, panel.y.range, script);
  }
  for (std::size_t i = 0; i < panel.layers.size(); ++i) {
    elements.push_back(layer_element(panel, i, script));
  }
  return elements;
}

std::vector<std::string> heading_of(const Page& page, const Stack& stack,
                                    const std::string& jumps) {
  const std::vector<Picture>& layers = stack.panels.front();
  const auto common = [&](const std::string Picture::*text) {
    const bool same = std::all_of(layers.begin(), layers.end(), [&](const Picture& layer) {
      return layer.*text == layers.front().*text;
    });
    return same ? layers.front().*text : "";
  };
  std::string remark = common(&Picture::remark);
  if (!jumps.empty()) remark += (remark.empty() ? "" : "; ") + jumps;
  return heading_lines(page, common(&Picture::title),
                       stack.panels.size() == 1 ? meaning_of(layers.front()) : "", remark);
}

// Heights of panels, in widths of the page, where none is asked for.
double panel_height(std::size_t panels) { return panels == 1 ? 0.5 : panels == 2 ? 0.33 : 0.25; }

// The curves of a panel, whose frame and axes stand already. number: its place among the data.
void add_curves(const Page& page, const Panel& panel, const AxisRange& x, const Frame& frame,
                std::size_t number, PlotScript* script) {
  const bool is_poincare = panel.layers.front().map.is_poincare();
  if (!is_poincare) script->text += grid_lines();
  if (!panel.classes && panel.y.range.min < 0.0 && panel.y.range.max > 0.0 && !is_poincare) {
    script->text += "set xzeroaxis linetype 1 linewidth 1 linecolor rgb '#777777'\n";
  }
  script->text += jump_marks(panel);
  const std::vector<std::string> elements = elements_of(page, panel, x, frame, number, script);
  script->text += fmt::format("plot {}", fmt::join(elements, ", \\\n     "));
  for (std::size_t layer = 0; layer < panel.layers.size(); ++layer) {
    add_missing_marks(panel.layers[layer],
                      panel.layers.size() > 1 ? layer_colour(layer) : kMissingColour, script);
  }
  script->text += "\n";
}

}  // namespace

PlotScript plot_stack(const Page& page, const Stack& stack) {
  const double em = page.em(), gap = 0.8 * em;
  const auto count = static_cast<double>(stack.panels.size());
  std::vector<Panel> panels;
  for (const std::vector<Picture>& layers : stack.panels) {
    panels.emplace_back(page, layers, panels.empty());
    panels.back().upwards = stack.upwards;
  }
  const std::vector<std::string> heading =
      heading_of(page, stack, jump_remark(panels.front(), stack.names));
  const std::vector<KeyEntry> key = key_entries(stack);
  const ResultAxis axis = whole_axis(stack.panels.front());
  const std::string x_markup =
      page.style().xlabel ? literal(*page.style().xlabel) : axis_label(axis);
  PanelAxis x{label_lines(page, x_markup, page.width()),
              axis_range(axis, page.style().xrange, "--xrange")};
  const double foot = key_height(page, key) + bottom_room(page, x);
  const double head = head_room(page, heading);

  PlotScript script;
  script.height = page.height_or(foot + head + (count - 1.0) * gap +
                                 count * panel_height(stack.panels.size()) * page.width());
  const double length = (script.height - foot - head - (count - 1.0) * gap) / count;
  for (Panel& panel : panels) panel.y.label = label_lines(page, panel.label, length);
  double left = 0.0;
  for (Panel& panel : panels) left = std::max(left, left_room(page, panel.axis(), length));

  // A long number may stand at the right end.
  const double widest = tics_of(page, "x", x.range, page.width() - left, true).widest;
  const double right = std::max(edge_room(page), 0.5 * widest + 0.2 * em);

  script.text = "set multiplot\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Panel& panel = panels[i];
    const double top = script.height - head - static_cast<double>(i) * (length + gap);
    const Frame frame{left, page.width() - right, top - length, top};
    ensure_room(frame, page);
    const bool is_last = i + 1 == panels.size();
    PanelAxis own_x = x;
    own_x.has_numbers = is_last;
    if (!is_last) own_x.label.clear();
    script.text += panel_lines(page, frame, script.height, own_x, panel.axis());
    if (i == 0) script.text += plot_heading(page, heading, frame, script.height);
    if (is_last) script.text += plot_key(page, key, script.height);
    add_curves(page, panel, x.range, frame, i + 1, &script);
  }
  script.text += "unset multiplot\n";
  return script;
}

}  // namespace gearsweep
