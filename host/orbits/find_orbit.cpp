#include "orbits/find_orbit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "model/error.hpp"
#include "orbits/returns.hpp"

namespace gearsweep {
namespace {

using Eigen::VectorXd;

constexpr std::size_t kGuesses = 8;  // of an orbit inside chaos
constexpr double kSameOrbit = 1e-8;  // of the states' sizes: two states of one orbit
constexpr double kSameCycle = 1e-6;  // the same where steps differ
constexpr double kArrived = 1e-4;    // of the way from the start to an equilibrium
constexpr double kRest = 1e-12;      // of states' magnitudes
// That the multiplier along a cycle may be off: coarse steps make it less, and a cycle that is none
// or begins at a surface makes it of the size of 1.
constexpr double kCloses = 0.1;
constexpr std::size_t kMaxSteps = 1 << 21;  // in search of returns

RunError left_range() {
  return RunError("the trajectory left the finite range while an orbit was looked for");
}

// A state of a trajectory that others are compared with, and when it was there: in periods of the
// forcing, or dimensionless time.
struct Visit {
  VectorXd state;
  double time = 0.0;
};
using Visits = std::vector<Visit>;

// The smallest divisor of the orbit's period after which the state is back.
std::size_t min_period(const PeriodMap& map, const Orbit& orbit) {
  VectorXd state = orbit.state;
  for (std::size_t divisor = 1; divisor < orbit.period; ++divisor) {
    const std::optional<VectorXd> next = map.advance(state, 1);
    if (!next) break;
    state = *next;
    if (orbit.period % divisor == 0 &&
        distance_of(map.difference(state, orbit.state), orbit.sizes) < kSameOrbit) {
      return divisor;
    }
  }
  return orbit.period;
}

// The states at phase 0 of a trajectory, its start first.
Visits section(const PeriodMap& map, const VectorXd& start, std::size_t periods) {
  Visits visits = {{start, 0.0}};
  while (visits.size() <= periods) {
    std::optional<VectorXd> next = map.advance(visits.back().state, 1);
    if (!next) throw left_range();
    visits.push_back({*std::move(next), static_cast<double>(visits.size())});
  }
  return visits;
}

// The sizes of states on a trajectory, of which `visits` are a section.
VectorXd sizes_of_section(const PeriodMap& map, const Visits& visits) {
  std::optional<PeriodImage> image = map.linearize(visits.back().state, 1);
  if (!image) throw left_range();
  for (const Visit& visit : visits) image->extent.take(visit.state);
  return sizes_of(*image);
}

// The smallest period after which the last state of a trajectory repeats an earlier one. Close
// returns come first: a coarse tolerance would take an orbit that has just doubled for the one
// before. 0 when there is none.
std::size_t return_period(const PeriodMap& map, const Visits& visits, const VectorXd& sizes) {
  const VectorXd& last = visits.back().state;
  for (int digits = 9; digits >= 3; --digits) {
    const double tolerance = std::pow(10.0, -digits);
    for (std::size_t period = 1; period < visits.size(); ++period) {
      const VectorXd& earlier = visits[visits.size() - 1 - period].state;
      if (distance_of(map.difference(last, earlier), sizes) < tolerance) return period;
    }
  }
  return 0;
}

// Where a trajectory comes back most nearly after `period` visits, the best first.
std::vector<std::size_t> closest_returns(const PeriodMap& map, const Visits& visits,
                                         const VectorXd& sizes, std::size_t period) {
  std::vector<std::pair<double, std::size_t>> moved;
  for (std::size_t i = 0; i + period < visits.size(); ++i) {
    const VectorXd way = map.difference(visits[i + period].state, visits[i].state);
    moved.emplace_back(distance_of(way, sizes), i);
  }
  std::sort(moved.begin(), moved.end());
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < std::min(kGuesses, moved.size()); ++i) {
    out.push_back(moved[i].second);
  }
  return out;
}

RunError no_return(std::size_t count, const std::string& unit) {
  return RunError(
      fmt::format("the trajectory does not repeat itself within {} {}: it is chaotic, or not "
                  "settled (raise integrate.settle). An unstable orbit inside chaos can be found "
                  "with --period",
                  count, unit));
}

RunError no_orbit(std::size_t period) {
  return RunError(
      fmt::format("Newton's method found no orbit of period {}: try a longer integrate.settle, "
                  "another --period, or more --steps",
                  period));
}

RunError other_period(std::size_t found, std::size_t wanted) {
  return RunError(fmt::format(
      "Newton's method came to an orbit of period {}, not {}: give --period {}, or another start "
      "(a state in --at)",
      found, wanted, found));
}

// The moments at which a motion that nothing drives returns (orbits/returns.hpp).
class Returns {
 public:
  Returns(const PeriodMap& map, const VectorXd& start, double step)
      : map_(map), step_(step), here_{start, 0.0}, extent_{start, start} {}

  // The next ones, or as many as there are in the steps that are taken at most; RunError that says
  // so where there are too few to tell a cycle by.
  void visit(std::size_t count, std::size_t fewest) {
    for (std::size_t steps = 0; visits_.size() < count; ++steps) {
      if (steps == kMaxSteps && visits_.size() >= fewest) return;
      if (steps == kMaxSteps) {
        throw RunError(fmt::format(
            "in {} steps of {:.3g} the motion makes no {}: there is nothing to tell a cycle by",
            kMaxSteps, step_, describe_returns(map_.model(), fewest)));
      }
      const PeriodMap::Way way = way_of(step_);
      if (way.returns > 0) visits_.push_back(return_within());
      here_ = {way.end, here_.time + step_};
      extent_.take(here_.state);
    }
  }
  const Visits& visits() const { return visits_; }
  // The sizes of the states on the way so far.
  VectorXd sizes() const { return sizes_of(extent_); }

 private:
  PeriodMap::Way way_of(double time) const {
    std::optional<PeriodMap::Way> way = map_.way(here_.state, TimeSpan{time, 1});
    if (!way) throw left_range();
    return *std::move(way);
  }
  Visit return_within() const {
    double low = 0.0, high = step_;
    for (double middle = 0.5 * step_; low < middle && middle < high; middle = 0.5 * (low + high)) {
      (way_of(middle).returns == 0 ? low : high) = middle;
    }
    return {way_of(high).end, here_.time + high};
  }

  const PeriodMap& map_;
  double step_;
  Visit here_;
  Extent extent_;
  Visits visits_;
};

// That of the moments of a way that is farthest from all surfaces, each in units of what its level
// reaches; where there are none, or the motion leaves the range, its start.
VectorXd farthest_from_surfaces(const PeriodMap& map, const VectorXd& start, const TimeSpan& way) {
  constexpr std::size_t kMoments = 32;
  if (map.model().surfaces.empty()) return start;
  const TimeSpan part = {way.duration / static_cast<double>(kMoments),
                         (way.steps + kMoments - 1) / kMoments};
  std::vector<VectorXd> states = {start}, levels;
  VectorXd reach = VectorXd::Zero(static_cast<Eigen::Index>(map.model().surfaces.size()));
  for (std::size_t i = 0; i < kMoments; ++i) {
    levels.push_back(map.levels(states.back()).cwiseAbs());
    reach = reach.cwiseMax(levels.back());
    std::optional<VectorXd> next = map.advance(states.back(), part);
    if (!next) return start;
    states.push_back(*std::move(next));
  }
  const auto distance = [&](const VectorXd& level) {
    return level.cwiseQuotient(above_zero(reach)).minCoeff();
  };
  const auto farthest = std::ranges::max_element(levels, {}, distance);
  return states[static_cast<std::size_t>(farthest - levels.begin())];
}

// Whether a cycle carries a step along it round to the same, as it must.
bool closes(const Orbit& cycle) {
  return std::fabs(*cycle.along - 1.0) <= std::max(kCloses, cycle.slack);
}

// The shortest share of a cycle, of those that a whole number of its returns make, after which it
// is back.
Orbit shortest_of(const PeriodMap& map, const Orbit& cycle) {
  for (std::size_t times = cycle.period; times > 1; --times) {
    if (cycle.period % times != 0) continue;
    const TimeSpan share = {cycle.duration / static_cast<double>(times),
                            (cycle.steps + times - 1) / times};
    const std::optional<VectorXd> there = map.advance(cycle.state, share);
    if (!there || distance_of(map.difference(*there, cycle.state), cycle.sizes) > kSameCycle) {
      continue;
    }
    if (const std::optional<Orbit> found = shoot_cycle(map, cycle.state, share)) return *found;
  }
  return cycle;
}

}  // namespace

Orbit find_orbit(const PeriodMap& map, const VectorXd& settled, std::optional<std::size_t> period) {
  const Visits visits = section(map, settled, kLongestPeriod + 4 * period.value_or(0));
  const VectorXd sizes = sizes_of_section(map, visits);
  const std::size_t wanted = period ? *period : return_period(map, visits, sizes);
  if (wanted == 0) throw no_return(kLongestPeriod, "periods");
  std::optional<Orbit> found;
  if (!period) {
    found = shoot(map, visits.back().state, wanted);
  } else {
    for (const std::size_t from : closest_returns(map, visits, sizes, wanted)) {
      if (!found) found = shoot(map, visits[from].state, wanted);
    }
  }
  if (!found) throw no_orbit(wanted);
  const std::size_t min = min_period(map, *found);
  if (min == wanted) return *found;
  if (period) throw other_period(min, wanted);
  const std::optional<PeriodImage> image = map.linearize(found->state, min);
  return make_orbit(found->state, *image, min);
}

Orbit find_cycle(const PeriodMap& map, const VectorXd& settled, const CycleSearch& search) {
  Returns returns(map, settled, search.step);
  returns.visit(kLongestPeriod + 1 + 4 * search.period.value_or(0), search.period.value_or(1) + 1);
  const Visits& visits = returns.visits();
  const VectorXd sizes = returns.sizes();
  const std::size_t wanted = search.period ? *search.period : return_period(map, visits, sizes);
  if (wanted == 0) throw no_return(visits.size() - 1, "returns");
  std::vector<std::size_t> guesses = {visits.size() - 1 - wanted};
  if (search.period) guesses = closest_returns(map, visits, sizes, wanted);
  std::optional<Orbit> found;
  for (const std::size_t from : guesses) {
    if (found) break;
    const double duration = visits[from + wanted].time - visits[from].time;
    const double asked =
        std::max(std::ceil(duration / search.step), static_cast<double>(search.steps * wanted));
    // Angles may have gone around often.
    const VectorXd guess = map.difference(visits[from].state, VectorXd::Zero(settled.size()));
    const TimeSpan span = {duration, static_cast<std::size_t>(asked)};
    found = shoot_cycle(map, guess, span);
    // A return may lie at a surface, on either side of which its neighbours begin.
    if (!found || !closes(*found)) {
      found = shoot_cycle(map, farthest_from_surfaces(map, guess, span), span);
    }
    if (found && !closes(*found)) found.reset();
  }
  if (!found) throw no_orbit(wanted);
  const Orbit cycle = shortest_of(map, *found);
  if (search.period && cycle.period != wanted) throw other_period(cycle.period, wanted);
  return cycle;
}

Orbit away_from_surfaces(const PeriodMap& map, const Orbit& cycle) {
  if (cycle.kind != OrbitKind::cycle) return cycle;
  const TimeSpan span = {cycle.duration, cycle.steps};
  const VectorXd state = farthest_from_surfaces(map, cycle.state, span);
  return state == cycle.state ? cycle : shoot_cycle(map, state, span).value_or(cycle);
}

std::optional<Orbit> find_rest(const PeriodMap& map, const VectorXd& start,
                               const VectorXd& settled) {
  std::optional<Orbit> rest = find_equilibrium(map, settled, map.difference(start, settled));
  if (!rest || !rest->stable()) return std::nullopt;
  const VectorXd left = map.difference(settled, rest->state).cwiseAbs();
  const VectorXd allowed =
      kArrived * spread_of(map.difference(start, rest->state).cwiseAbs(), rest->monodromy, 1.0);
  if ((left.array() > allowed.cwiseMax(kRest * rest->extent.reach()).array()).any())
    return std::nullopt;
  return rest;
}

}  // namespace gearsweep
