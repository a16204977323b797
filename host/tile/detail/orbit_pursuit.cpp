#include "tile/detail/orbit_pursuit.hpp"

#include <algorithm>
#include <iterator>

#include "model/array.hpp"
#include "model/on_all_cores.hpp"
#include "sweep_types.h"
#include "tile/subset.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxSteps = 5;  // of Newton's method

// `close` is where a step of Newton's method leaves only its square. In fp32 the map's rounding,
// which a multiplier near 1 makes a step some 30 times as long, asks for more.
NewtonLimits limits_of(const Study& study, double far, double kept) {
  const bool fp64 = study.integrate.fp64;
  return {study.selection.period_tolerance,
          fp64 ? 1e-4 : 1e-3,
          far,
          fp64 ? 1e-10 : 1e-3,
          study.model->angles,
          lost_multiplier(!study.model->surfaces.empty(), fp64),
          kept};
}

// The attempts as an engine takes them.
struct Guesses {
  std::vector<std::size_t> positions;
  std::vector<double> states;  // [attempt][state]
  std::vector<std::uint32_t> lengths;
};

Guesses guesses_of(const OrbitPursuit::Attempts& attempts) {
  Guesses guesses;
  for (const OrbitAttempt* attempt : attempts) {
    guesses.positions.push_back(attempt->position);
    append(attempt->newton.state, &guesses.states);
    guesses.lengths.push_back(attempt->length);
  }
  return guesses;
}

std::vector<OrbitAttempt*> those_with(const std::vector<OrbitAttempt*>& attempts,
                                      NewtonVerdict verdict) {
  std::vector<OrbitAttempt*> out;
  std::copy_if(attempts.begin(), attempts.end(), std::back_inserter(out),
               [&](const OrbitAttempt* attempt) { return attempt->verdict == verdict; });
  return out;
}

}  // namespace

OrbitPursuit::OrbitPursuit(const Plan& plan, const Tile& tile, OrbitEngine* engine, double far,
                           double kept)
    : plan_(plan),
      tile_(tile),
      engine_(engine),
      limits_(limits_of(plan.study(), far, kept)),
      states_(plan.study().model->states.size()),
      tangents_(plan.study().selection.tangent_count()) {}

bool OrbitPursuit::find(const Attempts& attempts, const RoundCallback& after_round) {
  Attempts open = attempts;
  for (std::size_t i = 0; i < kMaxSteps && !open.empty(); ++i) {
    if (!step(open, after_round)) return false;
    // Each turn brings them nearer by a factor, or they are close no longer.
    Attempts close = those_with(open, NewtonVerdict::close);
    while (!close.empty()) {
      if (!confirm(close, after_round)) return false;
      close = those_with(close, NewtonVerdict::close);
    }
    open = those_with(open, NewtonVerdict::going_on);
  }
  return true;
}

std::optional<ReturnMaps> OrbitPursuit::maps_of(const Attempts& attempts,
                                                const RoundCallback& after_round) {
  const Guesses guesses = guesses_of(attempts);
  const Tile subset = subset_of(plan_, tile_, guesses.positions, 1);
  return engine_->return_maps(plan_, subset, guesses.states, guesses.lengths, after_round);
}

// A step of Newton's method for each.
bool OrbitPursuit::step(const Attempts& attempts, const RoundCallback& after_round) {
  const std::optional<ReturnMaps> maps = maps_of(attempts, after_round);
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

// Whether those that came close come back. One that does so after a part of its length goes on with
// that: an orbit's multipliers over the minimal period say whether it is stable.
bool OrbitPursuit::confirm(const Attempts& close, const RoundCallback& after_round) {
  const Guesses guesses = guesses_of(close);
  const Tile subset = subset_of(plan_, tile_, guesses.positions, 1);
  const std::optional<Sections> sections =
      engine_->follow(plan_, subset, guesses.states, guesses.lengths, after_round);
  if (!sections) return false;
  for_each_on_all_cores(close.size(), [&](std::size_t i) {
    OrbitAttempt& attempt = *close[i];
    for (std::uint32_t part = 1; part <= attempt.length / 2; ++part) {
      if (attempt.length % part != 0) continue;
      if (!comes_back(sections->state(i, part), limits_, attempt.newton)) continue;
      attempt.length = part;
      attempt.verdict = NewtonVerdict::going_on;
      attempt.newton.distance = std::numeric_limits<double>::infinity();
      return;
    }
    attempt.verdict = newton_confirm(sections->state(i, attempt.length), attempt.derivative,
                                     limits_, &attempt.newton);
  });
  return true;
}

bool OrbitPursuit::sharpen(Attempts found, const RoundCallback& after_round) {
  std::erase_if(found,
                [this](const OrbitAttempt* one) { return one->newton.step <= limits_.same; });
  if (tangents_ == 0 || found.empty()) return true;
  const std::optional<ReturnMaps> maps = maps_of(found, after_round);
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
