#include "io/plot_scale.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "io/plot_text.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

// Viridis, 16 of its colours.
constexpr std::array<const char*, 16> kSequential = {
    "#440154", "#481a6c", "#472f7d", "#414487", "#39568c", "#31688e", "#2a788e", "#23888e",
    "#1f988b", "#22a884", "#35b779", "#54c568", "#7ad151", "#a5db36", "#d2e21b", "#fde725"};

// Blue to white to red-brown, as dark at either end: told apart with any colour vision. The place
// of each colour is a share of the least (below zero) or the greatest value.
constexpr std::array<std::pair<double, const char*>, 9> kDiverging = {{{-1.0, "#0b2f66"},
                                                                       {-0.7, "#2f6fb0"},
                                                                       {-0.4, "#86b8dc"},
                                                                       {-0.1, "#dcebf5"},
                                                                       {0.0, "#ffffff"},
                                                                       {0.1, "#fdd3a5"},
                                                                       {0.4, "#f08a4b"},
                                                                       {0.7, "#c2441c"},
                                                                       {1.0, "#6b1d08"}}};

// Okabe and Ito's colours, which the colour-blind tell apart too.
constexpr std::array<const char*, 8> kDistinct = {"#0072b2", "#e69f00", "#009e73", "#cc79a7",
                                                  "#56b4e9", "#d55e00", "#f0e442", "#000000"};

// Of curves laid over one another: dark ones first, and dashes for print without colours.
struct LayerStyle {
  const char *colour, *dashes;
};
constexpr std::array<LayerStyle, 6> kLayers = {{{"#0072b2", "1"},
                                                {"#d55e00", "(9,4)"},
                                                {"#009e73", "(5,3)"},
                                                {"#000000", "(12,3,3,3)"},
                                                {"#cc79a7", "(18,5)"},
                                                {"#e69f00", "(2,2)"}}};

std::vector<double> finite(const std::vector<double>& values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out),
               [](double value) { return std::isfinite(value); });
  return out;
}

ClassScale named_classes(const std::vector<std::string>& flags) {
  ClassScale scale;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    scale.values.push_back(static_cast<double>(i));
    constexpr std::size_t kLongestName = 40;  // that leaves room for the picture
    std::string name = shortened(flags[i], kLongestName);
    std::replace(name.begin(), name.end(), '_', ' ');
    scale.names.push_back(name);
    scale.colours.emplace_back(kDistinct[i % kDistinct.size()]);
  }
  return scale;
}

// Numbers have an order, so their colours come from the sequential palette.
ClassScale numbered_classes(const std::set<double>& numbers, bool with_others) {
  ClassScale scale;
  const std::size_t classes = numbers.size() + (with_others ? 1 : 0);
  const auto add = [&](const std::string& name) {
    const std::size_t colour = classes == 1
                                   ? kSequential.size() / 2
                                   : scale.names.size() * (kSequential.size() - 1) / (classes - 1);
    scale.names.push_back(name);
    scale.colours.emplace_back(kSequential[colour]);
  };
  for (const double number : numbers) {
    scale.values.push_back(number);
    add(fmt::format("{}", number));
  }
  if (with_others) add("other");
  return scale;
}

ValueRange not_empty(const ValueRange& range) {
  const double smallest = std::max(1e-9 * std::abs(range.least), 1e-300);
  if (range.greatest - range.least >= smallest) return range;
  const double half = range.least == 0.0 ? 0.5 : 0.05 * std::abs(range.least);
  return {range.least - half, range.least + half, false};
}

}  // namespace

std::vector<double> cell_edges(const ResultAxis& axis) {
  std::vector<double> values = axis.values;
  const bool logarithmic = axis.logarithmic;
  const auto transform = [&](double value) { return logarithmic ? std::log10(value) : value; };
  const auto back = [&](double value) { return logarithmic ? std::pow(10.0, value) : value; };
  std::transform(values.begin(), values.end(), values.begin(), transform);
  if (values.size() == 1) {
    const double half = logarithmic ? 0.05 : std::max(0.05 * std::abs(values[0]), 1e-3);
    return {back(values[0] - half), back(values[0] + half)};
  }
  const std::size_t last = values.size() - 1;
  std::vector<double> edges = {back(values[0] - 0.5 * (values[1] - values[0]))};
  for (std::size_t i = 0; i < last; ++i) edges.push_back(back(0.5 * (values[i] + values[i + 1])));
  edges.push_back(back(values[last] + 0.5 * (values[last] - values[last - 1])));
  return edges;
}

bool is_even(const ResultAxis& axis) {
  // gnuplot makes no image that is one pixel wide.
  if (axis.logarithmic || axis.values.size() < 2) return false;
  // Far less than a pixel, and more than the rounding of decimal values.
  constexpr double kTolerance = 1e-2;
  const double step =
      (axis.values.back() - axis.values.front()) / static_cast<double>(axis.values.size() - 1);
  for (std::size_t i = 0; i < axis.values.size(); ++i) {
    const double even = axis.values.front() + static_cast<double>(i) * step;
    if (std::abs(axis.values[i] - even) > kTolerance * step) return false;
  }
  return true;
}

void ensure_tellable(std::size_t layers) {
  if (layers <= kLayers.size()) return;
  throw InputError(
      fmt::format("{} are too many to be told apart when laid over one another; at most {}", layers,
                  kLayers.size()));
}

std::string layer_colour(std::size_t index) { return kLayers.at(index).colour; }

std::string layer_line(std::size_t index) {
  return fmt::format("linecolor rgb '{}' dashtype {}", kLayers.at(index).colour,
                     kLayers.at(index).dashes);
}

std::string sequential_palette() {
  std::vector<std::string> anchors;
  for (std::size_t i = 0; i < kSequential.size(); ++i) {
    anchors.push_back(fmt::format("{} '{}'", i, kSequential[i]));
  }
  return fmt::format("set palette defined ({})\n", fmt::join(anchors, ", "));
}

std::string diverging_palette(double least, double greatest) {
  std::vector<std::string> anchors;
  for (const auto& [share, colour] : kDiverging) {
    anchors.push_back(fmt::format("{} '{}'", share * (share < 0.0 ? -least : greatest), colour));
  }
  return fmt::format("set palette defined ({})\n", fmt::join(anchors, ", "));
}

double ClassScale::index_of(double value) const {
  const auto found = std::find(values.begin(), values.end(), value);
  const bool has_class = found != values.end() || (names.size() > values.size() && value == value);
  return has_class ? static_cast<double>(found - values.begin()) : std::nan("");
}

std::string ClassScale::palette() const {
  std::vector<std::string> bands, tics;
  for (std::size_t i = 0; i < names.size(); ++i) {
    bands.push_back(fmt::format("{} '{}', {} '{}'", i, colours[i], i + 1, colours[i]));
    tics.push_back(fmt::format("{} {}", quote_tic(literal(names[i])), i));
  }
  return fmt::format(
      "set palette maxcolors {0}\nset palette defined ({1})\nset cbrange [-0.5:{0}-0.5]\n"
      "set cbtics ({2}) scale 0\n",
      names.size(), fmt::join(bands, ", "), fmt::join(tics, ", "));
}

std::string ClassScale::tics() const {
  std::vector<std::string> tics;
  for (std::size_t i = 0; i < names.size(); ++i) {
    tics.push_back(fmt::format("{} {}", quote_tic(literal(names[i])), i));
  }
  return fmt::format("set yrange [-0.5:{}-0.5]\nset ytics ({})\n", names.size(),
                     fmt::join(tics, ", "));
}

std::optional<ClassScale> class_scale(const ResultMap& map) {
  if (!map.flags.empty()) return named_classes(map.flags);
  constexpr std::size_t kFew = 10;
  constexpr double kNearlyAll = 0.9;
  std::map<double, std::size_t> counts;
  std::size_t total = 0;
  for (const double value : map.values) {
    if (!std::isfinite(value)) continue;
    if (value != std::round(value)) return std::nullopt;
    ++counts[value];
    ++total;
  }
  if (counts.empty()) return std::nullopt;
  std::vector<std::pair<double, std::size_t>> frequent(counts.begin(), counts.end());
  std::stable_sort(frequent.begin(), frequent.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  const bool are_few = frequent.size() <= kFew;
  if (!are_few) frequent.resize(kFew - 1);
  std::set<double> numbers;
  std::size_t covered = 0;
  for (const auto& [number, count] : frequent) {
    numbers.insert(number);
    covered += count;
  }
  if (static_cast<double>(covered) < kNearlyAll * static_cast<double>(total)) return std::nullopt;
  return numbered_classes(numbers, !are_few);
}

ValueRange colour_range(const std::vector<double>& values) {
  std::vector<double> sorted = finite(values);
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  const std::size_t left_out = sorted.size() / 1000;
  ValueRange range = {sorted.front(), sorted.back(), false};
  const double least = sorted[left_out];
  const double greatest = sorted[sorted.size() - 1 - left_out];
  constexpr double kMuchWider = 3.0;
  if (greatest > least && sorted.back() - sorted.front() > kMuchWider * (greatest - least)) {
    range = {least, greatest, true};
  }
  return not_empty(range);
}

ValueRange padded_range(const std::vector<double>& values) {
  const std::vector<double> known = finite(values);
  if (known.empty()) return {};
  const auto [least, greatest] = std::minmax_element(known.begin(), known.end());
  const double margin = 0.04 * (*greatest - *least);
  return not_empty({*least - margin, *greatest + margin, false});
}

}  // namespace gearsweep
