#include "io/plot_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {

std::vector<std::string> title_lines(const std::string& title, const std::string& subtitle,
                                     const std::string& remark, bool for_column) {
  const std::size_t title_width = for_column ? 48 : 70;
  const std::size_t subtitle_width = for_column ? 66 : 110;
  std::vector<std::string> lines;
  for (const std::string& line : wrapped(title, title_width)) lines.push_back(literal(line));
  for (const std::string& line : wrapped(subtitle, subtitle_width)) {
    lines.push_back(fmt::format("{{/*0.8 {}}}", typeset(line)));
  }
  for (const std::string& line : wrapped(remark, subtitle_width)) {
    lines.push_back(fmt::format("{{/*0.8 {}}}", typeset(line)));
  }
  return lines;
}

std::string set_title(const std::vector<std::string>& lines) {
  return fmt::format("set title {}\n", quote(fmt::format("{}", fmt::join(lines, "\n"))));
}

std::string key_below(const std::vector<std::string>& entries) {
  if (entries.empty()) return "unset key\n";
  constexpr std::size_t kLine = 54, kSymbol = 6;  // in letters
  std::size_t longest = 1;
  for (const std::string& entry : entries) longest = std::max(longest, entry.size());
  const std::size_t columns = std::clamp<std::size_t>(kLine / (longest + kSymbol), 1, 3);
  const std::size_t rows = (entries.size() + columns - 1) / columns;
  return fmt::format(
      "set key at screen 0.5, screen 0.01 center bottom horizontal Left reverse samplen 2 "
      "maxcols {}\nset bmargin {:.1f}\n",
      columns, 4.1 + 1.1 * static_cast<double>(rows));
}

ChannelInfo shown_by(const Picture& picture) {
  const ResultMap& map = picture.map;
  return map.is_poincare() ? map.parts.front() : ChannelInfo{map.name, map.unit, map.meaning};
}

std::string meaning_of(const Picture& picture) {
  if (!picture.map.is_poincare()) return picture.map.meaning;
  return picture.map.parts.front().meaning + ", at phase 0 of each recorded period";
}

std::string frame(const Picture& picture) {
  const bool several_curves = picture.map.part_count() > 1;
  const std::string key = picture.missing.note.empty() && !several_curves
                              ? "unset key\nset bmargin 4\n"
                              : "set key at graph 0.5, screen 0.03 center center Left reverse "
                                "samplen 1.5 maxrows 1\nset bmargin 5.5\n";
  const std::string remark = picture.remark.empty() ? "" : "at " + picture.remark;
  return set_title(title_lines(picture.title, meaning_of(picture), remark, false)) +
         "set border linewidth 1\nset tics out nomirror\n" + key;
}

std::string axis_lines(char letter, const ResultAxis& axis) {
  const std::vector<double> edges = cell_edges(axis);
  return fmt::format("set {0}label {1}\nset {0}range [{2}:{3}]\n{4}", letter, quote(label_of(axis)),
                     edges.front(), edges.back(),
                     axis.logarithmic ? fmt::format("set logscale {}\n", letter) : "");
}

void add_missing_marks(const Picture& picture, const std::string& colour, PlotScript* script) {
  const std::vector<bool>& mask = picture.missing.mask;
  const auto count = std::count(mask.begin(), mask.end(), true);
  if (count == 0) return;
  script->text += fmt::format(
      ", \\\n     files.'-missing.dat' binary record=({}) skip={} format='%double' "
      "using 1:(0.012) axes x1y2 \\\n"
      "     with points pointtype 9 pointsize 0.8 linecolor rgb '{}' title {}",
      count, script->missing.size(), colour, quote(literal(picture.missing.note)));
  const std::vector<double>& x = picture.map.axes.front().values;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (mask[i]) append_numbers({x[i]}, &script->missing);
  }
}

std::string next_records(const PlotScript& script, std::size_t count, std::size_t columns) {
  return fmt::format("files.'.dat' binary record=({}) skip={} format='%{}double'", count,
                     script.data.size(), columns);
}

void append_numbers(std::initializer_list<double> numbers, std::string* out) {
  out->append(reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(double));
}

}  // namespace gearsweep
