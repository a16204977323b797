#include "plot/detail/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/error.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

// Lengths in font sizes.
constexpr double kFullLine = 1.35, kSmallLine = 1.15;
constexpr double kKeyLine = 1.45, kSymbol = 2.0, kSymbolGap = 0.5, kKeyGap = 1.6;
constexpr std::string_view kSmall = "{/*0.8 ";

}  // namespace

std::vector<std::string> heading_lines(const Page& page, const std::string& title,
                                       const std::string& subtitle, const std::string& remark) {
  const double letter = 0.56 * page.em();
  const auto width = static_cast<std::size_t>(std::max(10.0, 0.8 * page.width() / letter));
  const auto small_width = width * 5 / 4;
  const std::string shown = page.style().title.value_or(title);
  std::vector<std::string> lines;
  for (const std::string& line : wrapped(shown, width)) lines.push_back(literal(line));
  const auto add_small = [&](const std::string& markup) {
    lines.push_back(fmt::format("{}{}}}", kSmall, markup));
  };
  if (!page.is_for_print()) {
    for (const std::string& line : wrapped(subtitle, small_width)) add_small(typeset(line));
  }
  // Who wants no title says by other means where the picture is from.
  if (!remark.empty() && !(page.style().title && shown.empty())) add_small(remark);
  return lines;
}

double heading_height(const Page& page, const std::vector<std::string>& lines) {
  double height = 0.0;
  for (const std::string& line : lines) height += line.starts_with(kSmall) ? kSmallLine : kFullLine;
  return lines.empty() ? 0.0 : page.em() * (height + 0.3);
}

double head_room(const Page& page, const std::vector<std::string>& lines) {
  return lines.empty() ? 0.7 * page.em() : heading_height(page, lines) + 0.3 * page.em();
}

std::string plot_heading(const Page& page, const std::vector<std::string>& lines,
                         const Frame& frame, double height) {
  std::string text;
  double y = frame.top + heading_height(page, lines);
  for (const std::string& line : lines) {
    const double own = page.em() * (line.starts_with(kSmall) ? kSmallLine : kFullLine);
    // Over the axes; over the page where it is too wide for that.
    const bool fits = page.width_of(line) < frame.width() + frame.left;
    const double x = fits ? 0.5 * (frame.left + frame.right) : 0.5 * page.width();
    text += page.label_at(x, y - 0.5 * own, height, line, "center");
    y -= own;
  }
  return text;
}

namespace {

struct KeyGrid {
  std::size_t columns = 1, rows = 0;
  std::vector<double> lefts;  // of the columns, from the first
  double width = 0.0;         // of all
};

KeyGrid grid_of(const Page& page, const std::vector<KeyEntry>& entries) {
  const double room = page.width() - page.em(), gap = page.em() * kKeyGap;
  std::vector<double> widths;
  for (const KeyEntry& entry : entries) {
    widths.push_back(page.width_of(entry.text) + page.em() * (kSymbol + kSymbolGap) + gap);
  }
  const double widest = *std::ranges::max_element(widths);
  const double most = std::max(1.0, std::floor(room / widest));
  KeyGrid grid;
  grid.columns = std::min(entries.size(), static_cast<std::size_t>(most));
  // In one row where that can be done, with columns of different widths.
  const bool is_row = std::accumulate(widths.begin(), widths.end(), 0.0) - gap <= room;
  if (is_row) grid.columns = entries.size();
  grid.rows = (entries.size() + grid.columns - 1) / grid.columns;
  const bool is_even = static_cast<double>(grid.columns) <= most;
  for (std::size_t i = 0; i < grid.columns; ++i) {
    grid.lefts.push_back(grid.width);
    grid.width += is_even ? widest : widths[i];
  }
  grid.width -= gap;
  return grid;
}

// As gnuplot counts them.
int point_type(KeyEntry::Kind kind) {
  switch (kind) {
    case KeyEntry::Kind::kCircle:
      return 6;
    case KeyEntry::Kind::kTriangle:
      return 9;
    default:
      return 7;
  }
}

}  // namespace

double key_height(const Page& page, const std::vector<KeyEntry>& entries) {
  if (entries.empty()) return 0.0;
  return page.em() * (kKeyLine * static_cast<double>(grid_of(page, entries).rows) + 0.3);
}

std::string plot_key(const Page& page, const std::vector<KeyEntry>& entries, double height) {
  if (entries.empty()) return "";
  const KeyGrid grid = grid_of(page, entries);
  const double em = page.em();
  const double left = std::max(0.3 * em, 0.5 * (page.width() - grid.width));
  const auto at = [&](double x, double y) {
    return fmt::format("screen {:.5f}, screen {:.5f}", x / page.width(), y / height);
  };
  std::string text;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const KeyEntry& entry = entries[i];
    const std::size_t above = grid.rows - 1 - i / grid.columns;
    const auto row = static_cast<double>(above);
    const double x = left + grid.lefts[i % grid.columns];
    const double y = em * (0.2 + kKeyLine * (row + 0.5));
    const double right = x + em * kSymbol;
    const double middle = 0.5 * (x + right);
    switch (entry.kind) {
      case KeyEntry::Kind::kLine:
      case KeyEntry::Kind::kThinLine:
        text += fmt::format(
            "set arrow from {} to {} nohead linewidth {} linecolor rgb '{}' dashtype {}\n",
            at(x, y), at(right, y), entry.kind == KeyEntry::Kind::kLine ? 2 : 1, entry.colour,
            entry.dashes);
        break;
      case KeyEntry::Kind::kDot:
      case KeyEntry::Kind::kCircle:
      case KeyEntry::Kind::kTriangle:
        text += fmt::format(
            "set label '' at {} point pointtype {} pointsize dot*1.6 "
            "linecolor rgb '{}'\n",
            at(middle, y), point_type(entry.kind), entry.colour);
        break;
      case KeyEntry::Kind::kBox:
        text += fmt::format(
            "set object rectangle from {} to {} fillstyle solid 1 border linecolor rgb '#777777' "
            "fillcolor rgb '{}'\n",
            at(middle - 0.6 * em, y - 0.42 * em), at(middle + 0.6 * em, y + 0.42 * em),
            entry.colour);
        break;
    }
    text += page.label_at(right + em * kSymbolGap, y, height, entry.text, "left");
  }
  return text;
}

double left_room(const Page& page, const PanelAxis& y, double length) {
  const double em = page.em();
  double numbers = 0.0;
  if (y.classes != nullptr) {
    numbers = y.classes->widest(page);
  } else {
    numbers = tics_of(page, "y", y.range, length, y.has_numbers).widest;
  }
  return numbers + em * (0.85 + 0.35 + kFullLine * static_cast<double>(y.label.size()));
}

double bottom_room(const Page& page, const PanelAxis& x) {
  const double em = page.em();
  return em *
         ((x.has_numbers ? 1.75 : 0.5) + kFullLine * static_cast<double>(x.label.size()) + 0.1);
}

double edge_room(const Page& page) { return 1.1 * page.em(); }

std::string panel_lines(const Page& page, const Frame& frame, double height, const PanelAxis& x,
                        const PanelAxis& y) {
  const double em = page.em();
  std::string text = fmt::format(
      "reset\nunset key\nunset colorbox\nset border linewidth 1\nset x2range [0:1]\n"
      "set y2range [0:1]\n{}set xrange [{}:{}]\n{}",
      page.margins(frame, height), x.range.min, x.range.max,
      tics_of(page, "x", x.range, frame.width(), x.has_numbers).lines);
  if (y.classes != nullptr) {
    text += y.classes->tics(page, "y", true);
  } else {
    text += fmt::format("set yrange [{}:{}]\n{}", y.range.min, y.range.max,
                        tics_of(page, "y", y.range, frame.height(), y.has_numbers).lines);
  }
  double below = frame.bottom - em * ((x.has_numbers ? 1.75 : 0.5) + 0.5 * kFullLine);
  for (const std::string& line : x.label) {
    text += page.label_at(0.5 * (frame.left + frame.right), below, height, line, "center");
    below -= em * kFullLine;
  }
  double beside = frame.left - left_room(page, y, frame.height()) + em * (0.2 + 0.5 * kFullLine);
  for (const std::string& line : y.label) {
    text += page.label_at(beside, 0.5 * (frame.bottom + frame.top), height, line,
                          "center rotate by 90");
    beside += em * kFullLine;
  }
  return text;
}

void ensure_room(const Frame& frame, const Page& page) {
  if (frame.width() > 3.0 * page.em() && frame.height() > 3.0 * page.em()) return;
  throw InputError(
      "the letters leave no room for the picture; give a larger --size, a smaller --font or "
      "shorter "
      "labels");
}

std::string grid_lines() {
  return "set grid back linetype 1 linewidth 0.6 linecolor rgb '#dddddd'\n";
}

std::vector<std::string> label_lines(const Page& page, const std::string& markup, double length) {
  if (markup.empty()) return {};
  if (page.width_of(markup) <= length) return {markup};
  // At the blank outside of groups that leaves the shortest lines.
  std::size_t best = std::string::npos;
  double shortest = page.width_of(markup);
  int depth = 0;
  for (std::size_t i = 0; i < markup.size(); ++i) {
    if (markup[i] == '\\') {
      ++i;
    } else if (markup[i] == '{') {
      ++depth;
    } else if (markup[i] == '}') {
      --depth;
    } else if (markup[i] == ' ' && depth == 0) {
      const double longer =
          std::max(page.width_of(markup.substr(0, i)), page.width_of(markup.substr(i + 1)));
      if (longer < shortest) {
        shortest = longer;
        best = i;
      }
    }
  }
  if (best == std::string::npos) return {markup};
  return {markup.substr(0, best), markup.substr(best + 1)};
}

AxisRange axis_range(const ResultAxis& axis, const Limits& limits, const std::string& option) {
  const std::vector<double> edges = cell_edges(axis);
  const ValueRange range = limited({edges.front(), edges.back(), false}, limits, option);
  if (axis.logarithmic && range.min <= 0.0) {
    throw InputError(
        fmt::format("{}: the axis is logarithmic, so its ends must be above 0", option));
  }
  return {range.min, range.max, axis.logarithmic};
}

ChannelInfo shown_by(const Picture& picture) {
  const ResultMap& map = picture.map;
  return map.is_poincare() ? map.parts.front() : ChannelInfo{map.name, map.unit, map.meaning};
}

std::string meaning_of(const Picture& picture) {
  if (!picture.map.is_poincare()) return picture.map.meaning;
  // "states at phase 0 of each recorded period"
  const std::string& sampled = picture.map.meaning;
  const std::size_t at = sampled.find(" at ");
  return picture.map.parts.front().meaning +
         (at == std::string::npos ? "" : "," + sampled.substr(at));
}

void add_missing_marks(const Picture& picture, const std::string& colour, PlotScript* script) {
  const std::vector<bool>& mask = picture.missing.mask;
  const auto count = std::count(mask.begin(), mask.end(), true);
  if (count == 0) return;
  script->text += fmt::format(
      ", \\\n     files.'-missing.dat' binary record=({}) skip={} format='%double' "
      "using 1:(0.015) axes x1y2 \\\n"
      "     with points pointtype 9 pointsize dot linecolor rgb '{}' notitle",
      count, script->missing.size(), colour);
  const std::vector<double>& x = picture.map.axes.front().values;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (mask[i]) append_numbers({x[i]}, &script->missing);
  }
}

std::string next_records(const PlotScript& script, std::size_t count, std::size_t columns) {
  return fmt::format("data binary record=({}) skip={} format='%{}double'", count,
                     script.data.size(), columns);
}

void append_numbers(std::initializer_list<double> numbers, std::string* out) {
  out->append(reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(double));
}

}  // namespace gearsweep
