#include "plot/detail/scale.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "model/error.hpp"
#include "model/names.hpp"
#include "plot/detail/text.hpp"

namespace gearsweep {
namespace {

// Colours that the colour-blind tell apart, and of which the first four are also different shades
// of grey: six of Okabe and Ito (2008), "light cyan" of Paul Tol's scheme "light" and "wine" of his
// "muted" (2021). Black, grey and white are kept for what is no class of its own.
constexpr std::array<const char*, 8> kDistinct = {"#99ddff", "#d55e00", "#0072b2", "#e69f00",
                                                  "#009e73", "#f0e442", "#cc79a7", "#882255"};
// More, of "muted" and "bright" (Tol 2021), for attractors beyond the eighth.
constexpr std::array<const char*, 8> kFurther = {"#332288", "#ee6677", "#6699cc", "#117733",
                                                 "#ddcc77", "#661100", "#aa4499", "#44aa99"};
constexpr const char *kOthersColour = "#999933", *kNoneColour = "#ffffff";  // "olive" of "muted"
constexpr const char *kQuasiPeriodicColour = "#919191", *kChaoticColour = "#3d3d3d";

// Values beside the whole numbers of a map, for what is not periodic.
constexpr double kUndecided = -1.0, kQuasiPeriodic = -2.0, kChaotic = -3.0;

// Of curves laid over one another: dark and bright by turns, and dashes, for print without colours.
struct LayerStyle {
  const char *colour, *dashes;
};
constexpr std::array<LayerStyle, 6> kLayers = {{{"#0072b2", "1"},
                                                {"#e69f00", "(10,7)"},
                                                {"#009e73", "(5,6)"},
                                                {"#000000", "(14,6,3,6)"},
                                                {"#cc79a7", "(20,8)"},
                                                {"#d55e00", "(2,5)"}}};

std::vector<double> finite(const std::vector<double>& values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out),
               [](double value) { return std::isfinite(value); });
  return out;
}

std::set<double> values_in(const ResultMap& map) {
  std::set<double> values;
  for (const double value : map.values) {
    if (std::isfinite(value)) values.insert(value);
  }
  return values;
}

// "2_period_3" of a list of attractors as "attractor 2: period 3".
std::string class_name(const std::string& flag) {
  constexpr std::size_t kLongestName = 40;  // that leaves room for the picture
  std::string name = shortened(flag, kLongestName);
  std::replace(name.begin(), name.end(), '_', ' ');
  constexpr std::string_view kTorn = "quasi periodic";
  if (const std::size_t at = name.find(kTorn); at != std::string::npos) {
    name.replace(at, kTorn.size(), "quasi-periodic");
  }
  return literal(name);
}

// Nothing to be told has no colour, and what is not periodic is grey, as in maps of periods.
std::optional<std::string> own_colour(const std::string& flag) {
  if (flag == "undecided") return kNoneColour;
  if (flag == "quasi_periodic") return kQuasiPeriodicColour;
  if (flag == "chaotic") return kChaoticColour;
  return std::nullopt;
}

ClassScale named_classes(const ResultMap& map) {
  ClassScale scale;
  const std::set<double> present = values_in(map);
  const auto add = [&](std::size_t flag, const std::string& colour) {
    if (!present.contains(static_cast<double>(flag))) return;
    scale.values.push_back(static_cast<double>(flag));
    scale.names.push_back(class_name(map.flags[flag]));
    scale.colours.push_back(colour);
  };
  std::size_t colour = 0;
  bool has_others = false;
  for (std::size_t i = 0; i < map.flags.size(); ++i) {
    if (own_colour(map.flags[i])) continue;
    if (colour < kDistinct.size()) {
      add(i, kDistinct[colour]);
    } else if (colour < kDistinct.size() + kFurther.size()) {
      add(i, kFurther[colour - kDistinct.size()]);
    } else {
      has_others = has_others || present.contains(static_cast<double>(i));
    }
    ++colour;
  }
  // No colour stands for two classes: these are one.
  if (has_others) {
    scale.values.push_back(std::nan(""));
    scale.names.emplace_back("others");
    scale.colours.emplace_back(kOthersColour);
  }
  for (std::size_t i = map.flags.size(); i-- > 0;) {
    if (const auto own = own_colour(map.flags[i])) add(i, *own);
  }
  return scale;
}

// Numbers from 1 on have a colour each, whatever else the map holds.
ClassScale numbered_classes(const std::set<double>& numbers) {
  ClassScale scale;
  const auto add = [&](double value, const std::string& name, const std::string& colour) {
    scale.values.push_back(value);
    scale.names.push_back(name);
    scale.colours.push_back(colour);
  };
  std::vector<std::string> others;
  for (const double number : numbers) {
    if (number < 1.0) continue;
    const std::string name = fmt::format("{}", number);
    if (number <= static_cast<double>(kDistinct.size())) {
      add(number, name, kDistinct[static_cast<std::size_t>(number) - 1]);
    } else {
      others.push_back(name);
    }
  }
  if (!others.empty()) {
    constexpr std::size_t kFewNames = 3;
    add(std::nan(""),
        others.size() <= kFewNames ? fmt::format("{}", fmt::join(others, ", "))
                                   : fmt::format("> {}", kDistinct.size()),
        kOthersColour);
  }
  const auto add_if = [&](double value, const std::string& name, const std::string& colour) {
    if (numbers.contains(value)) add(value, name, colour);
  };
  add_if(kQuasiPeriodic, "quasi-periodic", kQuasiPeriodicColour);
  add_if(kChaotic, "chaotic", kChaoticColour);
  add_if(kUndecided, "undecided", kNoneColour);
  add_if(0.0, "0", kNoneColour);
  return scale;
}

ValueRange not_empty(const ValueRange& range) {
  const double smallest = std::max(1e-9 * std::abs(range.min), 1e-300);
  if (range.max - range.min >= smallest) return range;
  const double half = range.min == 0.0 ? 0.5 : 0.05 * std::abs(range.min);
  return {range.min - half, range.min + half, false};
}

// From the smallest value that has a logarithm.
ValueRange above_zero(const ValueRange& range, const std::vector<double>& values) {
  if (range.min > 0.0) return range;
  double min = std::numeric_limits<double>::infinity();
  for (const double value : values) {
    if (value > 0.0) min = std::min(min, value);
  }
  if (!(min < range.max)) {
    throw InputError("--log: no value is greater than 0, so none has a logarithm");
  }
  return {min, range.max, range.clipped};
}

}  // namespace

double between(double from, double to, double share, bool is_log) {
  return is_log ? from * std::pow(to / from, share) : from + share * (to - from);
}

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

void ensure_tellable(std::size_t layers) {
  if (layers <= kLayers.size()) return;
  throw InputError(
      fmt::format("{} are too many to be told apart when laid over one another; at most {}", layers,
                  kLayers.size()));
}

std::string layer_colour(std::size_t index) { return kLayers.at(index).colour; }

std::string layer_dashes(std::size_t index) { return kLayers.at(index).dashes; }

std::string layer_line(std::size_t index) {
  return fmt::format("linecolor rgb '{}' dashtype {}", kLayers.at(index).colour,
                     kLayers.at(index).dashes);
}

double ClassScale::index_of(double value) const {
  if (std::isnan(value)) return value;
  auto found = std::find(values.begin(), values.end(), value);
  if (found == values.end()) {
    found = std::find_if(values.begin(), values.end(), [](double own) { return std::isnan(own); });
  }
  return found == values.end() ? std::nan("") : static_cast<double>(found - values.begin());
}

std::string ClassScale::palette() const {
  std::vector<std::string> bands;
  for (std::size_t i = 0; i < names.size(); ++i) {
    bands.push_back(fmt::format("{} '{}', {} '{}'", i, colours[i], i + 1, colours[i]));
  }
  return fmt::format(
      "set palette maxcolors {0}\nset palette defined ({1})\nset cbrange [-0.5:{0}-0.5]\n",
      names.size(), fmt::join(bands, ", "));
}

std::string ClassScale::tics(const Page& page, const std::string& axis, bool marks) const {
  std::vector<std::string> tics;
  for (std::size_t i = 0; i < names.size(); ++i) {
    // gnuplot takes the label of a tic for a format of its number.
    std::string name;
    for (const char letter : page.text(names[i])) {
      name += letter == '%' ? "%%" : std::string(1, letter);
    }
    tics.push_back(fmt::format("{} {}", name, i));
  }
  return fmt::format(
      "set {0}range [-0.5:{1}-0.5]\nset {0}tics out nomirror scale {2} offset {3} ({4})\n", axis,
      names.size(), marks ? "tic,tic/2" : "0", tic_offset(axis), fmt::join(tics, ", "));
}

double ClassScale::widest(const Page& page) const {
  double widest = 0.0;
  for (const std::string& name : names) widest = std::max(widest, page.width_of(name));
  return widest;
}

std::optional<ClassScale> class_scale(const ResultMap& map) {
  if (!map.flags.empty()) {
    const ClassScale scale = named_classes(map);
    return scale.names.empty() ? std::nullopt : std::optional(scale);
  }
  constexpr std::size_t kFew = 10;
  constexpr double kNearlyAll = 0.9;
  const std::set<double> numbers = values_in(map);
  std::size_t total = 0, small = 0;
  for (const double value : map.values) {
    if (!std::isfinite(value)) continue;
    if (value != std::round(value)) return std::nullopt;
    ++total;
    if (value <= static_cast<double>(kDistinct.size())) ++small;
  }
  const bool has_signs = !numbers.empty() && *numbers.begin() < 0.0 && map.name != "period";
  if (numbers.empty() || has_signs) return std::nullopt;
  const bool are_few = numbers.size() <= kFew;
  const bool are_small = static_cast<double>(small) >= kNearlyAll * static_cast<double>(total);
  const bool are_periods = map.name == "period" || map.name == "attractor_count";
  if (!are_periods && !are_small && !are_few) return std::nullopt;
  return numbered_classes(numbers);
}

void tell_classes_apart(const ResultMap* motion, const ResultMap* contact, ResultMap* map) {
  if (map->name == "period" && motion != nullptr) {
    const auto value_of = [&](const std::string& name) {
      const auto flag = std::find(motion->flags.begin(), motion->flags.end(), name);
      return flag == motion->flags.end() ? std::nan("")
                                         : static_cast<double>(flag - motion->flags.begin());
    };
    const double chaotic = value_of("chaotic"), quasi = value_of("quasi_periodic");
    for (std::size_t i = 0; i < map->values.size() && i < motion->values.size(); ++i) {
      if (map->values[i] != 0.0) continue;
      map->values[i] = motion->values[i] == chaotic ? kChaotic
                       : motion->values[i] == quasi ? kQuasiPeriodic
                                                    : kUndecided;
    }
  }
  if (map->name != "attractor") return;
  for (std::size_t i = 1; i < map->flags.size(); ++i) {
    const std::vector<std::string> words = split(map->flags[i], '_');
    if (words.size() < 2 || words.front() != fmt::format("{}", i)) continue;
    const std::vector<std::string> rest(words.begin() + 1, words.end());
    std::string name = fmt::format("attractor {}: {}", i, fmt::join(rest, " "));
    std::size_t points = 0, hit = 0;
    const std::size_t shared =
        contact == nullptr ? 0 : std::min(map->values.size(), contact->values.size());
    for (std::size_t j = 0; j < shared; ++j) {
      if (map->values[j] != static_cast<double>(i) || !std::isfinite(contact->values[j])) continue;
      ++points;
      if (contact->values[j] > 0.0) ++hit;
    }
    if (points > 0) name += hit == 0 ? ", no impacts" : 2 * hit > points ? ", with impacts" : "";
    map->flags[i] = name;
  }
}

ValueRange limited(const ValueRange& range, const Limits& limits, const std::string& option) {
  ValueRange out = range;
  if (limits.min) out.min = *limits.min;
  if (limits.max) out.max = *limits.max;
  if (limits.min && limits.max) out.clipped = false;
  if (out.min < out.max) return out;
  throw InputError(fmt::format("{}: nothing lies there; the values go from {:.6g} to {:.6g}",
                               option, range.min, range.max));
}

ValueRange scale_range(const ValueRange& range, const std::vector<double>& values,
                       const Limits& limits, bool is_log, const std::string& option) {
  if (!is_log) return limited(range, limits, option);
  for (const std::optional<double>& end : {limits.min, limits.max}) {
    if (!end || *end > 0.0) continue;
    throw InputError(fmt::format("{}: with --log its ends must be above 0, not {}", option, *end));
  }
  return limited(limits.min ? range : above_zero(range, values), limits, option);
}

ValueRange colour_range(const std::vector<double>& values) {
  std::vector<double> sorted = finite(values);
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  const std::size_t left_out = sorted.size() / 1000;
  ValueRange range = {sorted.front(), sorted.back(), false};
  const double min = sorted[left_out];
  const double max = sorted[sorted.size() - 1 - left_out];
  constexpr double kMuchWider = 3.0;
  if (max > min && sorted.back() - sorted.front() > kMuchWider * (max - min)) {
    range = {min, max, true};
  }
  return not_empty(range);
}

ValueRange padded_range(const std::vector<double>& values) {
  const std::vector<double> known = finite(values);
  if (known.empty()) return {};
  const auto [min, max] = std::minmax_element(known.begin(), known.end());
  const double margin = 0.04 * (*max - *min);
  return not_empty({*min - margin, *max + margin, false});
}

}  // namespace gearsweep
