#include "tile/detail/orbit_pursuit.hpp"

#include <algorithm>
#include <iterator>

#include "model/array.hpp"
#include "sweep_types.h"
#include "tile/detail/on_all_cores.hpp"
#include "tile/subset.hpp"

namespace gearsweep {
namespace {

// The orbit that a trajectory settles on is not farther than this from where the trajectory nearly
// comes back, in ranges of the motion.
constexpr double kFar = 1e-1;
constexpr std::size_t kMaxSteps = 5;  // of Newton's method

// `close` is where a step of Newton's method leaves only its square. In fp32 the map's rounding,
// which a multiplier near 1 makes a step some 30 times as long, asks for more.
NewtonLimits limits_of(const Study& study) {
  const bool fp64 = study.integrate.fp64;
  return {study.selection.period_tolerance, fp64 ? 1e-4 : 1e-3, kFar, fp64 ? 1e-10 : 1e-3,
          study.model->angles};
}

std::vector<std::uint32_t> lengths_of(const std::vector<OrbitAttempt*>& attempts) {
  std::vector<std::uint32_t> lengths;
  for (const OrbitAttempt* attempt : attempts) lengths.push_back(attempt->length);
  return lengths;
}

std::vector<OrbitAttempt*> those_with(const std::vector<OrbitAttempt*>& attempts,
                                      NewtonVerdict verdict) {
  std::vector<OrbitAttempt*> out;
  std::copy_if(attempts.begin(), attempts.end(), std::back_inserter(out),
               [&](const OrbitAttempt* attempt) { return attempt->verdict == verdict; });
  return out;
}

}  // namespace

OrbitPursuit::OrbitPursuit(const Plan& plan, const Tile& tile, OrbitEngine* engine)
    : plan_(plan),
      tile_(tile),
      engine_(engine),
      limits_(limits_of(plan.study())),
      states_(plan.study().model->states.size()),
      tangents_(plan.study().selection.tangent_count()) {}

bool OrbitPursuit::find(const Attempts& attempts, const RoundCallback& after_round) {
  Attempts open = attempts;
  for (std::size_t i = 0; i < kMaxSteps && !open.empty(); ++i) {
    if (!step(open, after_round) || !confirm(those_with(open, NewtonVerdict::close), after_round) ||
        !shorten(those_with(open, NewtonVerdict::found), after_round)) {
      return false;
    }
    open = those_with(open, NewtonVerdict::going_on);
  }
  return true;
}

std::optional<ReturnMaps> OrbitPursuit::maps_of(const Attempts& attempts,
                                                const std::vector<std::uint32_t>& lengths,
                                                bool with_derivatives,
                                                const RoundCallback& after_round) {
  std::vector<std::size_t> positions;
  std::vector<double> guesses;
  for (const OrbitAttempt* attempt : attempts) {
    positions.push_back(attempt->position);
    append(attempt->newton.state, &guesses);
  }
  const Tile subset = subset_of(plan_, tile_, positions, 1);
  return engine_->return_maps(plan_, subset, guesses, lengths, with_derivatives, after_round);
}

// A step of Newton's method for each.
bool OrbitPursuit::step(const Attempts& attempts, const RoundCallback& after_round) {
  const std::optional<ReturnMaps> maps = maps_of(attempts, lengths_of(attempts), true, after_round);
  if (!maps) return false;
  const Array2 states(maps->states, states_), derivatives(maps->derivatives, states_ * states_);
  for_each_on_all_cores(attempts.size(), [&](std::size_t i) {
    OrbitAttempt& attempt = *attempts[i];
    const std::span<const double> derivative = derivatives[i];
    attempt.verdict = newton_step(states[i], derivative, limits_, tangents_, &attempt.newton);
    if (attempt.verdict == NewtonVerdict::close) {
      attempt.derivative.assign(derivative.begin(), derivative.end());
    }
  });
  return true;
}

// Whether those that came close come back.
bool OrbitPursuit::confirm(const Attempts& close, const RoundCallback& after_round) {
  if (close.empty()) return true;
  const std::optional<ReturnMaps> maps = maps_of(close, lengths_of(close), false, after_round);
  if (!maps) return false;
  const Array2 states(maps->states, states_);
  for_each_on_all_cores(close.size(), [&](std::size_t i) {
    close[i]->verdict = newton_confirm(states[i], close[i]->derivative, limits_, &close[i]->newton);
  });
  return true;
}

// An orbit that comes back after a divisor of its length goes on with that: its multipliers over
// the minimal period say whether it is stable.
bool OrbitPursuit::shorten(const Attempts& found, const RoundCallback& after_round) {
  for (const std::uint32_t prime : {2U, 3U, 5U, 7U, 11U, 13U}) {
    Attempts divisible = found;
    while (true) {
      std::erase_if(divisible, [&](const OrbitAttempt* one) { return one->length % prime != 0; });
      if (divisible.empty()) break;
      std::vector<std::uint32_t> lengths = lengths_of(divisible);
      for (std::uint32_t& length : lengths) length /= prime;
      const std::optional<ReturnMaps> maps = maps_of(divisible, lengths, false, after_round);
      if (!maps) return false;
      Attempts shorter;
      for (std::size_t i = 0; i < divisible.size(); ++i) {
        OrbitAttempt& attempt = *divisible[i];
        if (!comes_back(Array2(maps->states, states_)[i], limits_, attempt.newton)) continue;
        attempt.length = lengths[i];
        attempt.verdict = NewtonVerdict::going_on;
        attempt.newton.distance = std::numeric_limits<double>::infinity();
        shorter.push_back(&attempt);
      }
      divisible = std::move(shorter);
    }
  }
  return true;
}

bool OrbitPursuit::sharpen(Attempts found, const RoundCallback& after_round) {
  std::erase_if(found,
                [this](const OrbitAttempt* one) { return one->newton.step <= limits_.same; });
  if (tangents_ == 0 || found.empty()) return true;
  const std::optional<ReturnMaps> maps = maps_of(found, lengths_of(found), true, after_round);
  if (!maps) return false;
  const Array2 states(maps->states, states_), derivatives(maps->derivatives, states_ * states_);
  for_each_on_all_cores(found.size(), [&](std::size_t i) {
    NewtonTry last = found[i]->newton;
    last.distance = std::numeric_limits<double>::infinity();
    const NewtonVerdict verdict = newton_step(states[i], derivatives[i], limits_, tangents_, &last);
    if (verdict != NewtonVerdict::close) found[i]->verdict = verdict;
    found[i]->newton = std::move(last);
  });
  return true;
}

}  // namespace gearsweep
