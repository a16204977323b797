// Two axes: the map and its colour bar as images, so that no seam shows between cells or colours.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "model/names.hpp"
#include "plot/colours.hpp"
#include "plot/detail/contours.hpp"
#include "plot/detail/picture.hpp"
#include "plot/detail/raster.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

// What the colours stand for.
struct Colours {
  std::optional<ClassScale> classes;
  ValueRange range;
  Beyond beyond_range;
  bool is_log = false;

  Colours(const Page& page, const ResultMap& map) : classes(class_scale(map)) {
    const PlotStyle& style = page.style();
    if (classes) {
      const std::string why = fmt::format("'{}' is a map of classes or counts", map.name);
      for (const char* option : {"log", "contours"}) style.refuse(option, why);
      return;
    }
    is_log = style.is_log;
    name_ = style.colormap.empty() ? usual_colormap(map.name) : style.colormap;
    const ValueRange own =
        is_log ? colour_range(map.values) : with_middle(name_, map.name, colour_range(map.values));
    range = scale_range(own, map.values, style.range, is_log, "--range");
    beyond_range = beyond(range, map.values);
  }

  std::string palette() const {
    if (classes) return classes->palette();
    return palette_line(name_, range.min, range.max) +
           fmt::format("{}set cbrange [{}:{}]\n", is_log ? "set logscale cb\n" : "", range.min,
                       range.max);
  }
  // Values as they are coloured: classes by their index.
  double shade(double value) const {
    if (classes) return classes->index_of(value);
    const bool has_shade = std::isfinite(value) && (!is_log || value > 0.0);
    return has_shade ? value : std::nan("");
  }
  // The bar, from its foot to its top.
  Raster bar() const {
    // Many rows for a class: a viewer that smooths images blurs no more than one of them.
    constexpr std::size_t kSteps = 256, kStepsOfClass = 64;
    Raster raster{2, classes ? kStepsOfClass * classes->names.size() : kSteps, {}};
    for (std::size_t i = 0; i < raster.rows; ++i) {
      const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(raster.rows);
      const double value = classes ? std::floor(share * static_cast<double>(classes->names.size()))
                                   : between(range.min, range.max, share, is_log);
      raster.values.insert(raster.values.end(), 2, value);
    }
    return raster;
  }
  std::pair<std::string, std::string> ends() const { return end_colours(name_); }
  Tics tics(const Page& page, double length) const {
    if (classes) return {classes->tics(page, "y2", false), classes->widest(page)};
    Tics out = tics_of(page, "y2", {range.min, range.max, is_log}, length, true);
    out.lines = fmt::format("set y2range [{}:{}]\n", range.min, range.max) + out.lines;
    return out;
  }

 private:
  std::string name_;
};

std::string bar_label(const Page& page, const Picture& picture) {
  const ResultMap& map = picture.map;
  if (page.style().label) return literal(*page.style().label);
  if (!picture.bar_label.empty()) return picture.bar_label;
  return quantity_label(map.name, map.unit, page.style().words);
}

// A pointed end of a bar where there are values beyond it.
std::string bar_ends(const Page& page, const Colours& colours, const Frame& bar, double length,
                     double height) {
  const Beyond& beyond = colours.beyond_range;
  if (!beyond.below && !beyond.above) return "";
  const auto [below, above] = colours.ends();
  const auto triangle = [&](double foot, double tip, const std::string& colour) {
    const auto at = [&](double x, double y) {
      return fmt::format("screen {:.5f}, screen {:.5f}", x / page.width(), y / height);
    };
    return fmt::format(
        "set object polygon from {0} to {1} to {2} to {0} fillstyle solid 1 border linecolor rgb "
        "'#000000' fillcolor rgb '{3}'\n",
        at(bar.left, foot), at(bar.right, foot), at(0.5 * (bar.left + bar.right), tip), colour);
  };
  return (beyond.below ? triangle(bar.bottom, bar.bottom - length, below) : "") +
         (beyond.above ? triangle(bar.top, bar.top + length, above) : "");
}

// The bar is a plot of its own; its axes x1 and y1 go from 0 to 1.
std::string plot_bar(const Page& page, const Colours& colours, const Frame& whole, double height,
                     const std::vector<std::string>& label, PlotScript* script) {
  const double pointed = 0.8 * page.em();
  const Beyond& beyond = colours.beyond_range;
  const Frame frame{whole.left, whole.right, whole.bottom + (beyond.below ? pointed : 0.0),
                    whole.top - (beyond.above ? pointed : 0.0)};
  const Tics tics = colours.tics(page, frame.height());
  std::string text = "reset\nunset key\nunset colorbox\nset border linewidth 1\n" +
                     page.margins(frame, height) +
                     "set x2range [0:1]\nset xrange [0:1]\nset yrange [0:1]\nunset xtics\n"
                     "unset ytics\n" +
                     tics.lines + colours.palette();
  text += bar_ends(page, colours, frame, pointed, height);
  const double em = page.em();
  double beside = frame.right + tics.widest + em * (colours.classes ? 1.45 : 1.75);
  for (const std::string& line : label) {
    text += page.label_at(beside, 0.5 * (frame.bottom + frame.top), height, line,
                          "center rotate by 90");
    beside += 1.35 * em;
  }
  return text + "plot " + add_image(colours.bar(), "x1y1", script) + "\n";
}

// Points without a value are where this ground shows; it is black where classes are grey.
std::string missing_ground(const Colours& colours) {
  return fmt::format(
      "set object rectangle from graph 0, graph 0 to graph 1, graph 1 behind fillstyle solid 1 "
      "noborder fillcolor rgb '{}'\n",
      colours.classes ? kMissingClassColour : kMissingColour);
}

std::vector<Contour> contours_of(const Page& page, const Colours& colours, const ResultMap& map) {
  std::vector<Contour> contours;
  const Contours& asked = page.style().contours;
  if (!asked.any() || colours.classes) return contours;
  for (const double level : contour_levels(asked, colours.range, colours.is_log)) {
    contours.push_back({level, contour_pieces(map, level)});
  }
  return contours;
}

// The label of a line stands where it leaves the picture, at the right or at the top.
std::string line_label(const Page& page, const MapLine& line, const AxisRange& x,
                       const AxisRange& y) {
  const auto is_inside = [&](const std::pair<double, double>& point) {
    return point.first >= x.min && point.first <= x.max && point.second >= y.min &&
           point.second <= y.max;
  };
  const auto last = std::find_if(line.points.rbegin(), line.points.rend(), is_inside);
  if (line.label.empty() || last == line.points.rend()) return "";
  constexpr double kHigh = 0.94;  // above this share of the picture the label stands below its line
  const bool is_high = last->second > y.min + kHigh * (y.max - y.min);
  return fmt::format(
      "set label {} at {:.10g}, {:.10g} right front offset -0.3,{} textcolor rgb '{}'\n",
      page.text(line.label), last->first, last->second, is_high ? -0.6 : 0.5, line.colour);
}

std::string add_lines(const Picture& picture, PlotScript* script) {
  std::string text;
  for (const MapLine& line : picture.lines) {
    text += fmt::format(
        ", \\\n     {} using 1:2 with lines linewidth {} dashtype {} linecolor rgb '{}' notitle",
        next_records(*script, line.points.size(), 2), line.width, line.dashes, line.colour);
    for (const auto& [x, y] : line.points) append_numbers({x, y}, &script->data);
  }
  return text;
}

std::vector<std::string> one_line(const std::optional<std::string>& given,
                                  const std::string& otherwise) {
  const std::string markup = given ? literal(*given) : otherwise;
  return markup.empty() ? std::vector<std::string>{} : std::vector<std::string>{markup};
}

// Without the explanations "wedged: ..." of classes that the map does not show.
std::string meaning_of_shown(const std::string& meaning, const ResultMap& map,
                             const ClassScale& classes) {
  std::vector<std::string> kept;
  for (const std::string& clause : split(meaning, ';')) {
    const std::string name = clause.substr(0, clause.find(": "));
    const std::string word = name.substr(std::min(name.find_first_not_of(' '), name.size()));
    const auto flag = std::ranges::find(map.flags, word);
    const bool is_number = !word.empty() && word.find_first_not_of("0123456789") == word.npos;
    double value = std::nan("");
    if (flag != map.flags.end()) value = static_cast<double>(flag - map.flags.begin());
    if (is_number) value = std::stod(word);
    const bool is_of_class = name.size() < clause.size() && !std::isnan(value);
    if (is_of_class && std::ranges::count(classes.values, value) == 0) continue;
    kept.push_back(clause);
  }
  return fmt::format("{}", fmt::join(kept, ";"));
}

std::vector<std::string> map_heading(const Page& page, const Picture& picture,
                                     const Colours& colours, bool has_bar) {
  std::string meaning = colours.classes
                            ? meaning_of_shown(meaning_of(picture), picture.map, *colours.classes)
                            : meaning_of(picture);
  if (!colours.classes && colours.range.clipped) {
    meaning += "; the colours cover 99.8 % of the points";
  }
  std::string remark = picture.remark;
  // The subtitle, which a picture for print does not have, says the same.
  if (!has_bar && page.is_for_print()) {
    remark = bar_label(page, picture) + (remark.empty() ? "" : ", " + remark);
  }
  return heading_lines(page, picture.title, meaning, remark);
}

// A bar of classes whose names, with the label beside them, are long leaves the map too little of
// the page's width: they stand below it.
bool needs_bar(const Page& page, const Colours& colours) {
  constexpr double kWide = 0.2;    // of the page
  constexpr double kBeside = 3.0;  // em of bar and label
  return !colours.classes ||
         colours.classes->widest(page) + kBeside * page.em() < kWide * page.width();
}

// The classes, where no bar shows them; the picture's own entries; the points that are missing.
std::vector<KeyEntry> map_key(const Picture& picture, const Colours& colours, bool has_bar) {
  std::vector<KeyEntry> key;
  for (std::size_t i = 0; !has_bar && i < colours.classes->names.size(); ++i) {
    key.push_back(
        {KeyEntry::Kind::kBox, colours.classes->colours[i], "1", colours.classes->names[i]});
  }
  key.insert(key.end(), picture.key.begin(), picture.key.end());
  if (!picture.missing.note.empty()) {
    key.push_back({KeyEntry::Kind::kBox, colours.classes ? kMissingClassColour : kMissingColour,
                   "1", literal(picture.missing.note)});
  }
  return key;
}

}  // namespace

PlotScript plot_heat_map(const Page& page, const Picture& picture) {
  const ResultMap& map = picture.map;
  const PlotStyle& style = page.style();
  const Colours colours(page, map);
  const double em = page.em();
  const bool has_bar = needs_bar(page, colours);
  const std::vector<std::string> heading = map_heading(page, picture, colours, has_bar);
  const std::vector<KeyEntry> key = map_key(picture, colours, has_bar);
  PanelAxis x{one_line(style.xlabel, axis_label(map.axes[0])),
              axis_range(map.axes[0], style.xrange, "--xrange")};
  PanelAxis y{one_line(style.ylabel, axis_label(map.axes[1])),
              axis_range(map.axes[1], style.yrange, "--yrange")};

  PlotScript script;
  constexpr double kAspect = 0.75;
  script.height = page.height_or(kAspect * page.width() + key_height(page, key));
  Frame frame;
  frame.bottom = key_height(page, key) + bottom_room(page, x);
  frame.top = script.height - head_room(page, heading);
  y.label = label_lines(page, y.label.empty() ? "" : y.label.front(), frame.height());
  const std::vector<std::string> label =
      label_lines(page, bar_label(page, picture), frame.height());
  frame.left = left_room(page, y, frame.height());
  const double bar_width = has_bar ? 1.1 * em : 0.0, gap = has_bar ? 0.9 * em : 0.0;
  const double beside = !has_bar ? edge_room(page)
                                 : colours.tics(page, frame.height()).widest +
                                       em * ((colours.classes ? 0.75 : 1.05) +
                                             1.35 * static_cast<double>(label.size()) + 0.1);
  frame.right = page.width() - beside - bar_width - gap;
  ensure_room(frame, page);
  x.label = label_lines(page, x.label.empty() ? "" : x.label.front(), page.width());
  frame.bottom = key_height(page, key) + bottom_room(page, x);

  script.text = "set multiplot\n" + panel_lines(page, frame, script.height, x, y) +
                plot_heading(page, heading, frame, script.height) +
                plot_key(page, key, script.height) + colours.palette();
  if (!picture.missing.note.empty()) script.text += missing_ground(colours);
  for (const MapLine& line : picture.lines) {
    script.text += line_label(page, line, x.range, y.range);
  }
  const std::vector<Contour> contours = contours_of(page, colours, map);
  script.text += contour_labels(page, contours, x.range, y.range);
  std::vector<double> shades;
  for (const double value : map.values) shades.push_back(colours.shade(value));
  script.text +=
      "plot " + add_image(raster_of(page, map, shades, x.range, y.range), "x2y2", &script);
  script.text += add_contours(contours, &script) + add_lines(picture, &script) + "\n";
  if (has_bar) {
    const Frame bar{frame.right + gap, frame.right + gap + bar_width, frame.bottom, frame.top};
    script.text += plot_bar(page, colours, bar, script.height, label, &script);
  }
  script.text += "unset multiplot\n";
  return script;
}

}  // namespace gearsweep
