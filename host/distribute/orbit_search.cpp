#include "distribute/orbit_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <thread>

#include "distribute/parts.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// A trajectory that comes back to within kNear is worth a try, and the orbit that it settles on is
// not farther than kFar, both times the greatest component of the state.
constexpr double kNear = 3e-2;
constexpr double kFar = 1e-1;
constexpr std::size_t kMostSteps = 4;  // of Newton's method
// In `excluded` of an approach: no length at all.
constexpr std::uint32_t kAnyLength = (1U << ORBIT_LONGEST) - 1;

// `close` is as far as exponents stay better than those of a run to the end, which a window of
// records leaves uncertain by about 1e-3: 99 of 100 on coarse-backlash are within 2e-4. In fp32 the
// map's rounding, which a multiplier near 1 makes a step some 30 times as long, asks for more.
NewtonLimits limits_of(const Study& study) {
  const bool fp64 = study.integrate.fp64;
  return {study.selection.period_tolerance, fp64 ? 1e-4 : 1e-3, kFar, fp64 ? 1e-10 : 1e-3};
}

// Calls work(i) for all i below `count`, on all cores.
template <class Work>
void for_each_on_all_cores(std::size_t count, const Work& work) {
  constexpr std::size_t kShare = 32;
  std::atomic<std::size_t> next = 0;
  const auto run = [&] {
    for (std::size_t first = next.fetch_add(kShare); first < count;
         first = next.fetch_add(kShare)) {
      for (std::size_t i = first; i < std::min(count, first + kShare); ++i) work(i);
    }
  };
  const std::size_t useful = std::min<std::size_t>(
      (count + kShare - 1) / kShare, std::max(1U, std::thread::hardware_concurrency()));
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < useful; ++i) threads.emplace_back(run);
  run();
}

}  // namespace

struct OrbitSearch::Attempt {
  std::size_t index = 0;  // among the open points
  std::uint32_t length = 0;
  NewtonTry newton;
  NewtonVerdict verdict = NewtonVerdict::going_on;
};

OrbitSearch::OrbitSearch(const Plan& plan, const Tile& tile, const std::vector<double>& initial,
                         OrbitEngine* engine)
    : plan_(plan),
      tile_(tile),
      engine_(engine),
      open_(tile.points.size()),
      states_(initial),
      hopeless_(tile.points.size(), 0),
      next_try_(tile.points.size(), 0),
      is_found_(tile.points.size(), 0) {
  std::iota(open_.begin(), open_.end(), std::size_t{0});
}

bool OrbitSearch::can_advance() const {
  const Integrate& integrate = plan_.study().integrate;
  if (engine_ == nullptr || integrate.stop == Stop::never || open_.empty()) return false;
  const bool warms_up = plan_.study().selection.tangent_count() > 0;
  const std::size_t last =
      integrate.settle - (warms_up ? std::min(integrate.settle, integrate.warm_up) : 0);
  return settled_ + ORBIT_LONGEST <= last;
}

bool OrbitSearch::advance(const RoundCallback& after_round) {
  const Tile part = part_of(plan_, tile_, open_, ORBIT_LONGEST);
  settled_ += ORBIT_LONGEST;
  std::vector<std::uint32_t> excluded;
  for (const std::size_t position : open_) {
    excluded.push_back(settled_ < next_try_[position] ? kAnyLength : hopeless_[position]);
  }
  std::optional<Approach> approach =
      engine_->approach(plan_, part, states_, excluded, kNear, after_round);
  if (!approach) return false;
  states_ = std::move(approach->states);
  if (!pursue(attempts_from(*approach), after_round)) return false;
  close_points();
  return true;
}

// By phase grid, as a part wants them; the longest first, so that those that share a work-item take
// about as long.
std::vector<OrbitSearch::Attempt> OrbitSearch::attempts_from(const Approach& approach) const {
  const auto states = static_cast<std::ptrdiff_t>(plan_.study().model->states.size());
  std::vector<Attempt> attempts;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (approach.lengths[i] == 0) continue;
    Attempt attempt;
    attempt.index = i;
    attempt.length = approach.lengths[i];
    const auto first = static_cast<std::ptrdiff_t>(i) * states;
    attempt.newton.start.assign(states_.begin() + first, states_.begin() + first + states);
    attempt.newton.state.assign(approach.guesses.begin() + first,
                                approach.guesses.begin() + first + states);
    attempts.push_back(std::move(attempt));
  }
  const auto group = [&](const Attempt& attempt) {
    return std::make_pair(grid_of(tile_, open_[attempt.index]), -static_cast<int>(attempt.length));
  };
  std::stable_sort(attempts.begin(), attempts.end(),
                   [&](const Attempt& a, const Attempt& b) { return group(a) < group(b); });
  return attempts;
}

std::optional<ReturnMaps> OrbitSearch::maps_of(const std::vector<Attempt*>& attempts,
                                               bool with_derivatives,
                                               const RoundCallback& after_round) {
  std::vector<std::size_t> positions;
  std::vector<std::uint32_t> lengths;
  std::vector<double> guesses;
  for (const Attempt* attempt : attempts) {
    positions.push_back(open_[attempt->index]);
    lengths.push_back(attempt->length);
    guesses.insert(guesses.end(), attempt->newton.state.begin(), attempt->newton.state.end());
  }
  const Tile part = part_of(plan_, tile_, positions, 1);
  return engine_->return_maps(plan_, part, guesses, lengths, with_derivatives, after_round);
}

bool OrbitSearch::pursue(std::vector<Attempt> all, const RoundCallback& after_round) {
  std::vector<Attempt*> attempts;
  for (Attempt& attempt : all) attempts.push_back(&attempt);
  for (std::size_t step = 0; step < kMostSteps && !attempts.empty(); ++step) {
    if (!newton(attempts, after_round)) return false;
    for (Attempt* attempt : attempts) {
      const std::size_t position = open_[attempt->index];
      // Until it is found; the longer it takes, the less it costs to wait.
      next_try_[position] = settled_ + settled_ / 2;
      if (attempt->verdict == NewtonVerdict::unstable) {
        hopeless_[position] |= 1U << (attempt->length - 1);
      } else if (attempt->verdict == NewtonVerdict::found) {
        for (double& growth : attempt->newton.multipliers) growth /= attempt->length;
        found_.push_back({position, attempt->length, settled_, std::move(attempt->newton.state),
                          std::move(attempt->newton.multipliers)});
        is_found_[position] = 1;
      }
    }
    std::erase_if(attempts, [](const Attempt* attempt) {
      return attempt->verdict != NewtonVerdict::going_on;
    });
  }
  return true;
}

// One step of each, and where it gets close, a look at whether it comes back. False when the
// callback asked to stop.
bool OrbitSearch::newton(const std::vector<Attempt*>& attempts, const RoundCallback& after_round) {
  const NewtonLimits limits = limits_of(plan_.study());
  const std::size_t tangents = plan_.study().selection.tangent_count();
  const std::size_t states = plan_.study().model->states.size();
  const std::optional<ReturnMaps> maps = maps_of(attempts, true, after_round);
  if (!maps) return false;
  const auto derivative = [&](std::size_t i) {
    return maps->derivatives.data() + i * states * states;
  };
  for_each_on_all_cores(attempts.size(), [&](std::size_t i) {
    attempts[i]->verdict = newton_step(maps->states.data() + i * states, derivative(i), limits,
                                       tangents, &attempts[i]->newton);
  });

  std::vector<Attempt*> close;
  std::vector<const double*> slopes;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    if (attempts[i]->verdict != NewtonVerdict::close) continue;
    close.push_back(attempts[i]);
    slopes.push_back(derivative(i));
  }
  if (close.empty()) return true;
  const std::optional<ReturnMaps> again = maps_of(close, false, after_round);
  if (!again) return false;
  for_each_on_all_cores(close.size(), [&](std::size_t i) {
    close[i]->verdict =
        newton_confirm(again->states.data() + i * states, slopes[i], limits, &close[i]->newton);
  });
  return true;
}

// Takes out of the open points what was found, and what has diverged.
void OrbitSearch::close_points() {
  const std::size_t states = plan_.study().model->states.size();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (is_found_[open_[i]] != 0) continue;
    if (std::isnan(states_[i * states])) {
      diverged_.push_back(open_[i]);
      continue;
    }
    open_[kept] = open_[i];
    std::copy_n(states_.begin() + static_cast<std::ptrdiff_t>(i * states), states,
                states_.begin() + static_cast<std::ptrdiff_t>(kept * states));
    ++kept;
  }
  open_.resize(kept);
  states_.resize(kept * states);
}

}  // namespace gearsweep
