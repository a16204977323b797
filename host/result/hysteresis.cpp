#include "result/hysteresis.hpp"

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

// The range of all values of both.
double common_range(const ResultMap& up, const ResultMap& down) {
  double min = HUGE_VAL, max = -HUGE_VAL;
  for (const std::vector<double>* values : {&up.values, &down.values}) {
    for (const double value : *values) {
      if (!std::isfinite(value)) continue;
      min = std::min(min, value);
      max = std::max(max, value);
    }
  }
  return max - min;
}

// From the last place inside of a stretch to the first one outside, `leaper` goes most of the way
// to the other map, by more than twice what it changed before, and the other does not.
bool is_jump(const std::vector<double>& leaper, const std::vector<double>& other,
             std::size_t before, std::size_t inside, std::size_t outside) {
  const double leap = std::abs(leaper[outside] - leaper[inside]);
  const double half = 0.5 * std::abs(leaper[inside] - other[inside]);
  return leap > half && leap > 2.0 * std::abs(leaper[inside] - leaper[before]) &&
         std::abs(other[outside] - other[inside]) < half;
}

Hysteresis described(const ResultMap& up, const ResultMap& down, std::size_t first,
                     std::size_t last) {
  const std::vector<double>& x = up.axes.front().values;
  Hysteresis found{first, last, false, false, x[first], x[last]};
  found.jumps_down = first > 0 && is_jump(down.values, up.values, first + 1, first, first - 1);
  found.jumps_up = last + 1 < x.size() && is_jump(up.values, down.values, last - 1, last, last + 1);
  if (found.jumps_down) found.from = 0.5 * (x[first - 1] + x[first]);
  if (found.jumps_up) found.to = 0.5 * (x[last] + x[last + 1]);
  return found;
}

}  // namespace

std::vector<Hysteresis> find_hysteresis(const ResultMap& up, const ResultMap& down) {
  constexpr double kShare = 0.02;
  const bool is_comparable = up.axes.size() == 1 && down.axes.size() == 1 &&
                             up.axes.front().values == down.axes.front().values &&
                             up.values.size() == up.points() && down.values.size() == up.points();
  if (!is_comparable) return {};
  const double margin = kShare * common_range(up, down);
  const auto side_of = [&](std::size_t i) {
    const double difference = up.values[i] - down.values[i];
    return difference > margin ? 1 : difference < -margin ? -1 : 0;
  };
  std::vector<Hysteresis> found;
  for (std::size_t first = 0; first < up.points();) {
    const int side = side_of(first);
    std::size_t end = first + 1;
    while (end < up.points() && side_of(end) == side) ++end;
    if (side != 0 && end - first >= 2) {
      const Hysteresis stretch = described(up, down, first, end - 1);
      if (stretch.jumps_down || stretch.jumps_up) found.push_back(stretch);
    }
    first = end;
  }
  return found;
}

}  // namespace gearsweep
