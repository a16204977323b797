#include "plot/classes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

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
  return name;
}

// Nothing to be told has no colour, and what is not periodic is grey, as in maps of periods.
std::optional<std::string> own_colour(const std::string& flag) {
  if (flag == "undecided") return kNoneColour;
  if (flag == "quasi_periodic") return kQuasiPeriodicColour;
  if (flag == "chaotic") return kChaoticColour;
  return std::nullopt;
}

MapClasses named_classes(const ResultMap& map) {
  MapClasses scale;
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
MapClasses numbered_classes(const std::set<double>& numbers) {
  MapClasses scale;
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

}  // namespace

double MapClasses::index_of(double value) const {
  if (std::isnan(value)) return value;
  auto found = std::find(values.begin(), values.end(), value);
  if (found == values.end()) {
    found = std::find_if(values.begin(), values.end(), [](double own) { return std::isnan(own); });
  }
  return found == values.end() ? std::nan("") : static_cast<double>(found - values.begin());
}

std::optional<MapClasses> classes_in(const ResultMap& map) {
  if (!map.flags.empty()) {
    const MapClasses scale = named_classes(map);
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

}  // namespace gearsweep
