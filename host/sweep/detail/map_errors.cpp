#include "sweep/detail/map_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep_types.h"

namespace gearsweep {
namespace {

// One number for each point.
struct Values {
  std::string quantity;  // empty for samples
  std::string channel;   // that it looks at; empty: none
  bool has_classes;
  bool is_exponent;
  std::vector<double> numbers;  // [point]
};

bool is_compared(const Quantity& quantity) {
  return !quantity.of_census && !quantity.of_draws && quantity.role != OutputRole::exponent_error &&
         quantity.role != OutputRole::settled && quantity.role != OutputRole::angle;
}

std::vector<Values> values_of(const SweepResult& result) {
  const Selection& selection = result.study.selection;
  const std::size_t points = result.status.size();
  std::vector<Values> all;
  for (std::size_t i = 0; i < selection.quantities.size(); ++i) {
    const Quantity& quantity = selection.quantities[i];
    if (!is_compared(quantity)) continue;
    for (std::size_t k = 0; k < quantity.width; ++k) {
      all.push_back(
          {quantity.name, quantity.channel, !quantity.flags.empty(), is_exponent(quantity), {}});
      for (std::size_t point = 0; point < points; ++point) {
        all.back().numbers.push_back(result.values[i][point * quantity.width + k]);
      }
    }
  }
  for (std::size_t chosen = 0; chosen < selection.poincare.size(); ++chosen) {
    const std::string& state = result.study.model->states[selection.poincare[chosen]].name;
    Values low = {"", state, false, false, {}};
    Values high = low;
    for (std::size_t point = 0; point < points; ++point) {
      const std::vector<double> samples = samples_of(result, point, chosen);
      const auto [min, max] = std::minmax_element(samples.begin(), samples.end());
      low.numbers.push_back(*min);
      high.numbers.push_back(*max);
    }
    all.push_back(std::move(low));
    all.push_back(std::move(high));
  }
  return all;
}

// `share` is that of the numbers which lie beyond it.
double upper_quantile(const std::vector<double>& ascending, double share) {
  const auto kept = std::ceil((1.0 - share) * static_cast<double>(ascending.size()));
  return ascending[static_cast<std::size_t>(std::max(kept, 1.0)) - 1];
}

// What an error is relative to. The range of all but the outermost hundredth at either end, which a
// few points that diverge or resonate would stretch; the whole one where these are all alike. What
// varies by less than 64,000 roundings is taken to vary by that: a thousandth of it then still
// stands out from rounding. What varies by 4096 roundings at most is constant.
double scale_of(const Values& map, double rounding,
                const std::map<std::string, double>& motion_ranges) {
  if (map.has_classes) return 1.0;
  std::vector<double> ascending;
  for (const double number : map.numbers) {
    if (std::isfinite(number)) ascending.push_back(number);
  }
  if (ascending.empty()) return 0.0;
  std::sort(ascending.begin(), ascending.end());
  double range = upper_quantile(ascending, 0.01) - upper_quantile(ascending, 0.99);
  if (range == 0.0) range = ascending.back() - ascending.front();
  const double largest = std::max(std::abs(ascending.front()), std::abs(ascending.back()));
  if (range <= 4096.0 * rounding * largest || map.channel.empty()) return std::max(range, largest);
  range = std::max(range, 64e3 * rounding * largest);
  const auto motion = motion_ranges.find(map.channel);
  return motion == motion_ranges.end() ? range : std::max(range, motion->second);
}

// Two numbers that are none are the same.
double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0.0;
  return std::isnan(a - b) ? std::numeric_limits<double>::infinity() : a - b;
}

double error_of(const Values& map, double difference, double range) {
  if (difference == 0.0) return 0.0;
  return map.has_classes ? 1.0 : std::abs(difference) / range;
}

}  // namespace

bool is_exponent(const Quantity& quantity) {
  return quantity.role == OutputRole::exponent ||
         quantity.role == OutputRole::exponent_per_period || quantity.role == OutputRole::exponents;
}

MapErrors MapErrors::without_exponents() const {
  MapErrors others = *this;
  std::erase_if(others.maps_, [](const Map& map) { return map.is_exponent; });
  return others;
}

MapErrors::MapErrors(const SweepResult& coarse, const SweepResult& fine,
                     const Tolerances& tolerances,
                     const std::map<std::string, double>& motion_ranges)
    : is_judged_(fine.on_orbit) {
  const double rounding = fine.study.integrate.fp64 ? std::numeric_limits<double>::epsilon()
                                                    : std::numeric_limits<float>::epsilon();
  for (std::size_t point = 0; point < is_judged_.size(); ++point) {
    const bool is_lost = fine.status[point] != STATUS_ok && coarse.status[point] == STATUS_ok;
    if (is_lost && coarse.on_orbit[point] == 1) is_judged_[point] = 1;
  }
  points_ = static_cast<std::size_t>(std::count(is_judged_.begin(), is_judged_.end(), 1));
  const std::vector<Values> coarse_maps = values_of(coarse);
  const std::vector<Values> fine_maps = values_of(fine);
  for (std::size_t i = 0; i < fine_maps.size(); ++i) {
    const Values& map = fine_maps[i];
    const double range = scale_of(map, rounding, motion_ranges);
    Map errors = {.quantity = map.quantity,
                  .is_exponent = map.is_exponent,
                  .tolerance = map.is_exponent ? tolerances.exponents : tolerances.maps,
                  .errors = {},
                  .ascending = {}};
    double sum = 0.0, squares = 0.0, others = 0.0, missing = 0.0;
    for (std::size_t point = 0; point < map.numbers.size(); ++point) {
      const double off = difference(coarse_maps[i].numbers[point], map.numbers[point]);
      errors.errors.push_back(error_of(map, off, range));
      if (is_judged_[point] == 1) {
        errors.ascending.push_back(errors.errors.back());
      } else if (!std::isfinite(off)) {
        missing += 1.0;
      } else if (range > 0.0) {
        others += 1.0;
        sum += off / range;
        squares += off / range * (off / range);
      }
    }
    if (missing > 0.0) errors.missing = missing / (missing + others);
    if (others > 1.0) {
      errors.mean = sum / others;
      const double variance = std::max(squares / others - errors.mean * errors.mean, 0.0);
      errors.deviation = std::sqrt(variance / (others - 1.0));
    }
    std::sort(errors.ascending.begin(), errors.ascending.end());
    maps_.push_back(std::move(errors));
  }
}

std::size_t MapErrors::beyond() const {
  std::size_t most = 0;
  for (const Map& map : maps_) {
    const auto first = std::ranges::upper_bound(map.ascending, map.tolerance);
    most = std::max(most, static_cast<std::size_t>(map.ascending.end() - first));
  }
  return most;
}

std::size_t MapErrors::beyond_in_any() const {
  std::size_t count = 0;
  for (std::size_t point = 0; point < is_judged_.size(); ++point) {
    const bool is_off = std::ranges::any_of(
        maps_, [&](const Map& map) { return map.errors[point] > map.tolerance; });
    if (is_judged_[point] == 1 && is_off) ++count;
  }
  return count;
}

std::map<std::string, double> MapErrors::of_quantities(double share) const {
  std::map<std::string, double> out;
  for (const Map& map : maps_) {
    if (map.quantity.empty() || map.ascending.empty()) continue;
    double& error = out[map.quantity];
    error = std::max(error, upper_quantile(map.ascending, share));
  }
  return out;
}

double MapErrors::largest(double share) const {
  double largest = 0.0;
  for (const Map& map : maps_) {
    if (!map.ascending.empty()) largest = std::max(largest, upper_quantile(map.ascending, share));
  }
  return largest;
}

FurthestMap MapErrors::furthest(double share) const {
  FurthestMap furthest;
  for (const Map& map : maps_) {
    if (map.ascending.empty()) continue;
    const FurthestMap found = {map.quantity, map.is_exponent, upper_quantile(map.ascending, share),
                               map.tolerance};
    if (found.excess() > furthest.excess()) furthest = found;
  }
  return furthest;
}

bool MapErrors::others_agree(double share) const {
  return std::all_of(maps_.begin(), maps_.end(), [&](const Map& map) {
    return map.missing <= share &&
           std::abs(map.mean) <= std::max(map.tolerance, 3.0 * map.deviation);
  });
}

double MapErrors::sensitive_share(const std::vector<MapErrors>& halvings) {
  const MapErrors& last = halvings.back();
  const auto is_sensitive = [&](std::size_t map, std::size_t point) {
    const auto error = [&](const MapErrors& pair) {
      return std::min(pair.maps_[map].errors[point], 1.0);
    };
    if (last.maps_[map].errors[point] <= last.maps_[map].tolerance) return false;
    double fall = 1.0;  // that order one half makes of an error
    for (auto pair = halvings.rbegin() + 1; pair != halvings.rend(); ++pair) {
      fall *= std::sqrt(0.5);
      if (error(last) <= fall * error(*pair)) return false;
    }
    return true;
  };
  std::size_t most = 0;
  for (std::size_t map = 0; map < last.maps_.size(); ++map) {
    std::size_t sensitive = 0;
    for (std::size_t point = 0; point < last.is_judged_.size(); ++point) {
      if (last.is_judged_[point] == 1 && is_sensitive(map, point)) ++sensitive;
    }
    most = std::max(most, sensitive);
  }
  return most == 0 ? 0.0 : static_cast<double>(most) / static_cast<double>(last.points_);
}

}  // namespace gearsweep
