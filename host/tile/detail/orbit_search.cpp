#include "tile/detail/orbit_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "model/array.hpp"
#include "model/on_all_cores.hpp"
#include "sweep_types.h"
#include "tile/subset.hpp"

namespace gearsweep {
namespace {

// From far away: a point that is still under way may pass many an orbit.
constexpr SearchCriteria kFromAnywhere = {
    .near = 3e-2, .far = 1e-1, .longest_span = 1000, .kept = 0.0};
// A draw that starts on the nominal motion has its own orbit beside it, and lies where the return
// map is nearly linear.
constexpr SearchCriteria kFromNominal = {.near = 0.3, .far = 0.3, .longest_span = 1, .kept = 3e-2};
// Of an orbit from what other steps made of it, at most.
constexpr double kFarFromItself = 3e-2;
// In `excluded` of an approach: all lengths are excluded.
constexpr std::uint32_t kAnyLength = (1U << ORBIT_LONGEST) - 1;
// Periods of the first approach of a draw that starts on the nominal motion: so few returns mostly
// tell its orbit.
constexpr std::size_t kShortest = 4;

// Those that a short approach does not see twice.
std::uint32_t unseen_lengths(std::size_t periods) {
  return periods == ORBIT_LONGEST ? 0 : kAnyLength & ~((1U << (periods / 2)) - 1);
}

bool starts_at_nominal(const Plan& plan, const Tile& tile) {
  const Study& study = plan.study();
  return study.stages() > 1 && !study.is_chained() && tile.points.front() >= study.points();
}

}  // namespace

OrbitSearch::OrbitSearch(const Plan& plan, const Plan& orbit_plan, const Tile& tile,
                         const std::vector<double>& initial, std::size_t periods,
                         OrbitEngine* engine)
    : plan_(plan),
      orbit_plan_(orbit_plan),
      tile_(tile),
      periods_(periods),
      engine_(engine),
      is_near_nominal_(starts_at_nominal(plan, tile)),
      criteria_(is_near_nominal_ ? kFromNominal : kFromAnywhere),
      open_(tile.points.size()),
      states_(initial),
      hopeless_(tile.points.size(), 0),
      next_try_(tile.points.size(), 0),
      is_found_(tile.points.size(), 0),
      candidates_(tile.points.size()) {
  std::iota(open_.begin(), open_.end(), std::size_t{0});
}

bool OrbitSearch::can_advance() const {
  if (engine_ == nullptr || plan_.study().integrate.stop == Stop::never) return false;
  return !open_.empty() && settled_ + next_approach() <= periods_;
}

std::size_t OrbitSearch::next_approach() const {
  if (!is_near_nominal_) return ORBIT_LONGEST;
  return std::clamp(settled_, kShortest, std::size_t{ORBIT_LONGEST});
}

bool OrbitSearch::advance(const RoundCallback& after_round) {
  const std::size_t periods = next_approach();
  const Tile subset = subset_of(plan_, tile_, open_, periods);
  settled_ += periods;
  std::vector<std::uint32_t> excluded;
  for (const std::size_t position : open_) {
    const bool waits = candidates_[position] != nullptr || settled_ < next_try_[position];
    excluded.push_back(waits ? kAnyLength : hopeless_[position] | unseen_lengths(periods));
  }
  std::optional<Approach> approach =
      engine_->approach(plan_, subset, states_, periods, excluded,
                        {criteria_.near, plan_.study().selection.period_tolerance}, after_round);
  if (!approach) return false;
  states_ = std::move(approach->states);
  if (!find_candidates(*approach, after_round)) return false;
  watch(approach->sections, periods);
  if (!take_arrivals(after_round)) return false;
  close_points();
  return true;
}

// One attempt for each open point with a near return. They are sorted by phase grid, as a subset
// needs them, and then by length, so that attempts in the same work-item take about as long.
std::vector<OrbitAttempt> OrbitSearch::attempts_from(const Approach& approach) const {
  const std::size_t states = plan_.study().model->states.size();
  const auto numbers_of = [&](const std::vector<double>& all, std::size_t point) {
    const std::span<const double> own = Array2(all, states)[point];
    return std::vector<double>(own.begin(), own.end());
  };
  std::vector<OrbitAttempt> attempts;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (approach.lengths[i] == 0) continue;
    OrbitAttempt attempt;
    attempt.position = open_[i];
    attempt.length = approach.lengths[i];
    attempt.newton.start = numbers_of(states_, i);
    attempt.newton.state = numbers_of(approach.guesses, i);
    attempt.newton.ranges = numbers_of(approach.ranges, i);
    // Where a component does not move, distances are absolute.
    std::replace(attempt.newton.ranges.begin(), attempt.newton.ranges.end(), 0.0, 1.0);
    attempts.push_back(std::move(attempt));
  }
  const auto group = [&](const OrbitAttempt& attempt) {
    return std::make_pair(grid_of(tile_, attempt.position), -static_cast<int>(attempt.length));
  };
  std::stable_sort(
      attempts.begin(), attempts.end(),
      [&](const OrbitAttempt& a, const OrbitAttempt& b) { return group(a) < group(b); });
  return attempts;
}

bool OrbitSearch::find_candidates(const Approach& approach, const RoundCallback& after_round) {
  std::vector<OrbitAttempt> attempts = attempts_from(approach);
  std::vector<OrbitAttempt*> all;
  for (OrbitAttempt& attempt : attempts) all.push_back(&attempt);
  if (!OrbitPursuit(plan_, tile_, engine_, criteria_.far, criteria_.kept).find(all, after_round))
    return false;
  for_each_on_all_cores(attempts.size(), [&](std::size_t i) {
    OrbitAttempt& attempt = attempts[i];
    const std::size_t position = attempt.position;
    // The wait grows with the time that has passed, so that failed attempts cost a bounded share.
    next_try_[position] = settled_ + settled_ / 2;
    if (attempt.verdict == NewtonVerdict::unstable) {
      hopeless_[position] |= 1U << (attempt.length - 1);
    } else if (attempt.verdict == NewtonVerdict::found) {
      TargetOrbit target = {attempt.newton.state,
                            attempt.derivative,
                            std::exp(attempt.newton.log_multipliers.front()),
                            attempt.newton.ranges,
                            plan_.study().model->angles,
                            plan_.study().selection.period_tolerance};
      candidates_[position] = std::unique_ptr<Candidate>(
          new Candidate{std::move(attempt), settled_,
                        OrbitConvergence(std::move(target), criteria_.longest_span)});
    }
  });
  return true;
}

void OrbitSearch::watch(const Sections& sections, std::size_t periods) {
  for_each_on_all_cores(open_.size(), [&](std::size_t i) {
    Candidate* candidate = candidates_[open_[i]].get();
    if (candidate == nullptr) return;
    // The approach's section 0 is the last section of the one before, which an old candidate has
    // seen.
    const bool is_new = candidate->settled == settled_;
    const std::size_t length = candidate->orbit.length;
    for (std::size_t period = is_new ? 0 : 1; period <= periods; ++period) {
      // settled_ counts this approach already, so the section lies settled_ - periods + period
      // periods from the start. Its distance to the candidate's state is taken modulo the length; a
      // multiple of the length is added, as it may be negative.
      const std::size_t phase =
          (settled_ - candidate->settled + period + periods * (length - 1)) % length;
      if (phase != 0 || candidate->verdict != OrbitConvergence::Verdict::open) continue;
      candidate->verdict =
          candidate->convergence.add(sections.state(i, ORBIT_LONGEST - periods + period));
    }
  });
}

bool OrbitSearch::take_arrivals(const RoundCallback& after_round) {
  std::vector<OrbitAttempt*> arrivals;
  for (const std::size_t position : open_) {
    Candidate* candidate = candidates_[position].get();
    if (candidate == nullptr) continue;
    if (candidate->verdict == OrbitConvergence::Verdict::converges) {
      arrivals.push_back(&candidate->orbit);
    } else if (candidate->verdict == OrbitConvergence::Verdict::leaves) {
      next_try_[position] = settled_ + settled_ / 2;
      candidates_[position].reset();
    }
  }
  if (!refine(arrivals, after_round)) return false;
  for (OrbitAttempt* orbit : arrivals) {
    const std::size_t position = orbit->position;
    if (orbit->verdict == NewtonVerdict::found) {
      for (double& log : orbit->newton.log_multipliers) log /= orbit->length;
      found_.push_back({position, orbit->length, candidates_[position]->settled,
                        std::move(orbit->newton.state), std::move(orbit->newton.log_multipliers)});
      is_found_[position] = 1;
    }
    candidates_[position].reset();
  }
  return true;
}

bool OrbitSearch::refine(const OrbitPursuit::Attempts& arrivals, const RoundCallback& after_round) {
  const bool has_own_steps = plan_.study().integrate.orbit_steps > 1;
  OrbitPursuit pursuit(orbit_plan_, tile_, engine_, has_own_steps ? kFarFromItself : criteria_.far,
                       criteria_.kept);
  if (has_own_steps) {
    for (OrbitAttempt* orbit : arrivals) {
      orbit->verdict = NewtonVerdict::going_on;
      orbit->newton.start = orbit->newton.state;
      orbit->newton.distance = std::numeric_limits<double>::infinity();
    }
    if (!pursuit.find(arrivals, after_round)) return false;
  }
  OrbitPursuit::Attempts found = arrivals;
  std::erase_if(found,
                [](const OrbitAttempt* one) { return one->verdict != NewtonVerdict::found; });
  return pursuit.sharpen(std::move(found), after_round);
}

// Removes the points that were found or have diverged from the open points.
void OrbitSearch::close_points() {
  const Array2 states(states_, plan_.study().model->states.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (is_found_[open_[i]] != 0) continue;
    if (std::isnan(states[i].front())) {
      diverged_.push_back(open_[i]);
      continue;
    }
    open_[kept] = open_[i];
    std::ranges::copy(states[i], states[kept].begin());
    ++kept;
  }
  open_.resize(kept);
  states_.resize(kept * states.columns());
}

}  // namespace gearsweep
