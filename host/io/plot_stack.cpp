#include "io/plot_stack.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

// All lengths here are in widths of the picture.
constexpr double kLetter = 0.0165;  // mean width of the large letters

struct Layout {
  static constexpr double kLine = 0.04;  // from line to line of the large letters
  static constexpr double kGap = 0.03;   // between panels
  static constexpr double kRight = 0.96;
  double left = 0.0, top = 0.0, panel = 0.0, bottom = 0.0, key = 0.0;
  std::size_t panels = 0;

  double height() const {
    const auto count = static_cast<double>(panels);
    return top + count * panel + (count - 1.0) * kGap + bottom;
  }
  // The margins of a panel, the first at the top.
  std::string margins(std::size_t index) const {
    const double upper = height() - top - static_cast<double>(index) * (panel + kGap);
    return fmt::format(
        "set lmargin at screen {:.4f}\nset rmargin at screen {:.4f}\n"
        "set tmargin at screen {:.4f}\nset bmargin at screen {:.4f}\n",
        left, kRight, upper / height(), (upper - panel) / height());
  }
};

// A label that is not longer than a panel is high: in two lines, with smaller letters if need be.
struct PanelLabel {
  std::string text;
  bool has_two_lines = false;

  PanelLabel(const ChannelInfo& shown, double panel) {
    constexpr double kSmallest = 0.6;
    const double most = panel / kLetter;
    text = label_of(shown.name, shown.unit);
    const bool has_unit = !shown.unit.empty() && shown.unit != "1";
    const auto length = static_cast<double>(shown.name.size());
    has_two_lines =
        has_unit && static_cast<double>(shown.name.size() + shown.unit.size() + 3) > most;
    if (length > most) {
      text =
          fmt::format("{{/*{:.2f} {}}}", std::max(kSmallest, most / length), literal(shown.name));
    } else if (has_two_lines) {
      text = literal(shown.name);
    }
    if (has_two_lines) text += fmt::format("\n[{}]", typeset(shown.unit));
  }
};

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

ValueRange whole_range(const std::vector<Picture>& layers) {
  std::vector<double> values;
  for (const Picture& layer : layers) {
    values.insert(values.end(), layer.map.values.begin(), layer.map.values.end());
  }
  return padded_range(values);
}

// One study's values as a curve, or as dots at its classes.
void add_layer(const ResultMap& map, std::size_t index, const std::optional<ClassScale>& classes,
               PlotScript* script) {
  const std::string style =
      classes ? fmt::format("points pointtype 7 pointsize {}", index == 0 ? 1.0 : 0.6)
              : "lines linewidth 1.5";
  script->text += fmt::format(
      "{} using 1:2 with {} {} notitle", next_records(*script, map.points(), 2), style,
      classes ? fmt::format("linecolor rgb '{}'", layer_colour(index)) : layer_line(index));
  for (std::size_t i = 0; i < map.points(); ++i) {
    const double value = std::isfinite(map.values[i]) ? map.values[i] : std::nan("");
    append_numbers({map.axes.front().values[i], classes ? classes->index_of(value) : value},
                   &script->data);
  }
}

void add_layers(const std::vector<Picture>& layers, const std::string& label, PlotScript* script) {
  const ResultMap& first = layers.front().map;
  const ValueRange range = whole_range(layers);
  std::optional<ClassScale> classes;
  if (!first.flags.empty()) classes = class_scale(first);
  script->text += fmt::format(
      "set ylabel {}\nset y2range [0:1]\n{}", quote(label),
      classes ? classes->tics() : fmt::format("set yrange [{}:{}]\n", range.least, range.greatest));
  if (!first.is_poincare()) {
    script->text += "set grid linetype 1 linewidth 0.6 linecolor rgb '#dddddd'\n";
  }
  for (std::size_t i = 0; i < layers.size(); ++i) {
    script->text += i == 0 ? "plot " : ", \\\n     ";
    if (first.is_poincare()) {
      add_dots(layers[i].map, range, layer_colour(i), script);
    } else {
      add_layer(layers[i].map, i, classes, script);
    }
  }
  for (std::size_t i = 0; i < layers.size(); ++i) {
    add_missing_marks(layers[i], layers.size() > 1 ? layer_colour(i) : kMissingColour, script);
  }
}

// What the marks of missing values stand for: in words where all panels say the same.
std::vector<std::string> missing_entries(const Stack& stack) {
  std::vector<std::string> entries;
  for (std::size_t i = 0; i < stack.names.size(); ++i) {
    std::string note;
    for (const std::vector<Picture>& panel : stack.panels) {
      const std::string& own = panel[i].missing.note;
      if (!own.empty()) note = note.empty() || note == own ? own : "no value";
    }
    if (note.empty()) continue;
    const bool is_alone = stack.names.size() == 1;
    entries.push_back(
        fmt::format("keyentry with points pointtype 9 pointsize 0.8 linecolor rgb '{}' title {}",
                    is_alone ? kMissingColour : layer_colour(i),
                    quote(literal(is_alone ? note : fmt::format("{}: {}", stack.names[i], note)))));
  }
  return entries;
}

std::vector<std::string> key_entries(const Stack& stack) {
  std::vector<std::string> entries;
  for (std::size_t i = 0; i < stack.names.size() && stack.names.size() > 1; ++i) {
    entries.push_back(fmt::format("keyentry with lines linewidth 2 {} title {}", layer_line(i),
                                  quote(literal(stack.names[i]))));
  }
  if (stack.names.size() == 1) {
    for (const std::vector<Picture>& panel : stack.panels) {
      const std::vector<std::string> parts = part_entries(panel.front().map);
      entries.insert(entries.end(), parts.begin(), parts.end());
    }
  }
  const std::vector<std::string> missing = missing_entries(stack);
  entries.insert(entries.end(), missing.begin(), missing.end());
  return entries;
}

// The key is a plot of its own, without anything else, at the foot of the picture.
std::string key_plot(const std::vector<std::string>& entries, const Layout& layout) {
  return fmt::format(
      "reset\nunset border\nunset tics\nset xrange [0:1]\nset yrange [0:1]\n"
      "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\n"
      "set tmargin at screen {:.4f}\nset key inside center center Left reverse samplen 2 maxcols "
      "1\n"
      "plot NaN notitle, \\\n     {}\n",
      layout.key / layout.height(), fmt::join(entries, ", \\\n     "));
}

std::vector<std::string> title_of(const Stack& stack) {
  const std::vector<Picture>& layers = stack.panels.front();
  const auto common = [&](const std::string Picture::*text) {
    const bool same = std::all_of(layers.begin(), layers.end(), [&](const Picture& layer) {
      return layer.*text == layers.front().*text;
    });
    return same ? layers.front().*text : "";
  };
  const std::string remark = common(&Picture::remark);
  return title_lines(common(&Picture::title),
                     stack.panels.size() == 1 ? meaning_of(layers.front()) : "",
                     remark.empty() ? "" : "at " + remark, true);
}

Layout layout_of(const Stack& stack, std::size_t title_lines, std::size_t key_lines) {
  Layout layout;
  layout.panels = stack.panels.size();
  layout.panel = layout.panels == 1 ? 0.48 : layout.panels == 2 ? 0.33 : 0.26;
  layout.left = 0.17;
  for (const std::vector<Picture>& panel : stack.panels) {
    if (PanelLabel(shown_by(panel.front()), layout.panel).has_two_lines) {
      layout.left = std::max(layout.left, 0.2);
    }
    if (panel.front().map.flags.empty()) continue;
    const std::optional<ClassScale> classes = class_scale(panel.front().map);
    for (const std::string& name : classes->names) {
      layout.left = std::max(layout.left, 0.085 + kLetter * static_cast<double>(name.size()));
    }
  }
  layout.top = Layout::kLine * (static_cast<double>(title_lines) + 0.5);
  layout.key = Layout::kLine * (static_cast<double>(key_lines) + 0.5);
  layout.bottom = 0.12 + (key_lines == 0 ? 0.0 : layout.key);
  return layout;
}

}  // namespace

PlotScript draw_stack(const Stack& stack) {
  const std::vector<std::string> title = title_of(stack);
  const std::vector<std::string> entries = key_entries(stack);
  const Layout layout = layout_of(stack, title.size(), entries.size());
  PlotScript script;
  script.for_column = true;
  script.height = layout.height();
  script.text = "set multiplot\n";
  for (std::size_t i = 0; i < stack.panels.size(); ++i) {
    std::vector<Picture> layers = stack.panels[i];
    script.text +=
        "reset\nset border linewidth 1\nset tics out nomirror\nunset colorbox\nunset key\n" +
        layout.margins(i) + axis_lines('x', whole_axis(layers)) + (i == 0 ? set_title(title) : "");
    if (i + 1 < stack.panels.size()) script.text += "unset xlabel\nset format x ''\n";
    for (Picture& layer : layers) layer.missing.note.clear();
    const PanelLabel label(shown_by(layers.front()), layout.panel);
    if (layers.size() > 1 || layers.front().map.is_poincare()) {
      add_layers(layers, label.text, &script);
    } else {
      add_curve(layers.front(), label.text, &script);
    }
    script.text += "\n";
  }
  if (!entries.empty()) script.text += key_plot(entries, layout);
  script.text += "unset multiplot\n";
  return script;
}

}  // namespace gearsweep
