#include "io/plot_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "io/plot_scale.hpp"
#include "io/plot_text.hpp"

namespace gearsweep {
namespace {

// The study's title, below it smaller what the quantity is.
std::string title_of(const Picture& picture) {
  constexpr std::size_t kTitleWidth = 70, kSubtitleWidth = 110;
  std::string subtitle = picture.map.meaning;
  if (picture.map.is_poincare()) {
    subtitle = picture.map.parts.front().meaning + ", at phase 0 of each recorded period";
  }
  std::vector<std::string> lines;
  for (const std::string& line : wrapped(picture.title, kTitleWidth)) {
    lines.push_back(literal(line));
  }
  for (const std::string& line : wrapped(subtitle, kSubtitleWidth)) {
    lines.push_back(fmt::format("{{/*0.8 {}}}", typeset(line)));
  }
  if (!picture.remark.empty()) {
    lines.push_back(fmt::format("{{/*0.8 at {}}}", typeset(picture.remark)));
  }
  return quote(fmt::format("{}", fmt::join(lines, "\n")));
}

}  // namespace

std::string frame(const Picture& picture) {
  const bool several_curves = picture.map.part_count() > 1;
  const std::string key = picture.missing.note.empty() && !several_curves
                              ? "unset key\nset bmargin 4\n"
                              : "set key at graph 0.5, screen 0.03 center center Left reverse "
                                "samplen 1.5 maxrows 1\nset bmargin 5.5\n";
  return fmt::format("set title {}\nset border linewidth 1\nset tics out nomirror\n{}",
                     title_of(picture), key);
}

std::string axis_lines(char letter, const ResultAxis& axis) {
  const std::vector<double> edges = cell_edges(axis);
  return fmt::format("set {0}label {1}\nset {0}range [{2}:{3}]\n{4}", letter, quote(label_of(axis)),
                     edges.front(), edges.back(),
                     axis.logarithmic ? fmt::format("set logscale {}\n", letter) : "");
}

std::string missing_marks(const Picture& picture) {
  if (picture.missing.note.empty()) return "";
  const auto count = std::count(picture.missing.mask.begin(), picture.missing.mask.end(), true);
  return fmt::format(
      ", \\\n     files.'-missing.dat' binary record=({}) format='%double' using 1:(0.012) "
      "axes x1y2 \\\n     with points pointtype 9 pointsize 0.8 linecolor rgb '{}' title {}",
      count, kMissingColour, quote(literal(picture.missing.note)));
}

std::string missing_places(const Picture& picture) {
  std::string bytes;
  const std::vector<double>& x = picture.map.axes.front().values;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (picture.missing.mask[i]) append_numbers({x[i]}, &bytes);
  }
  return bytes;
}

void append_numbers(std::initializer_list<double> numbers, std::string* out) {
  out->append(reinterpret_cast<const char*>(numbers.begin()), numbers.size() * sizeof(double));
}

}  // namespace gearsweep
