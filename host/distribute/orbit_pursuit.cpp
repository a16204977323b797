#include "distribute/orbit_pursuit.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "distribute/orbit_convergence.hpp"
#include "distribute/parts.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// The orbit that a trajectory settles on is not farther than this from where the trajectory nearly
// comes back, in ranges of the motion.
constexpr double kFar = 1e-1;
constexpr std::size_t kMostSteps = 5;  // of Newton's method

// `close` is where a step of Newton's method leaves only its square. In fp32 the map's rounding,
// which a multiplier near 1 makes a step some 30 times as long, asks for more.
NewtonLimits limits_of(const Study& study) {
  const bool fp64 = study.integrate.fp64;
  return {study.selection.period_tolerance, fp64 ? 1e-4 : 1e-3, kFar, fp64 ? 1e-10 : 1e-3,
          study.model->angles};
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

OrbitConvergence convergence_to(const OrbitAttempt& attempt, const NewtonLimits& limits) {
  return OrbitConvergence({attempt.newton.state, attempt.derivative, attempt.newton.ranges,
                           limits.angles, limits.same});
}

}  // namespace

OrbitPursuit::OrbitPursuit(const Plan& plan, const Tile& tile, OrbitEngine* engine)
    : plan_(plan),
      tile_(tile),
      engine_(engine),
      limits_(limits_of(plan.study())),
      states_(plan.study().model->states.size()),
      tangents_(plan.study().selection.tangent_count()) {}

bool OrbitPursuit::run(std::vector<OrbitAttempt>* attempts, std::size_t most_periods,
                       const RoundCallback& after_round) {
  Attempts all, found;
  for (OrbitAttempt& attempt : *attempts) all.push_back(&attempt);
  Attempts open = all;
  for (std::size_t i = 0; i < kMostSteps && !open.empty(); ++i) {
    if (!step(open, after_round) || !confirm(those_with(open, NewtonVerdict::close), after_round) ||
        !shorten(those_with(open, NewtonVerdict::found), after_round)) {
      return false;
    }
    open = those_with(open, NewtonVerdict::going_on);
  }
  if (!follow(those_with(all, NewtonVerdict::found), most_periods, after_round)) return false;
  if (tangents_ == 0) return true;
  Attempts arriving;
  std::copy_if(all.begin(), all.end(), std::back_inserter(arriving),
               [this](const OrbitAttempt* attempt) {
                 return attempt->arrives && attempt->newton.step > limits_.same;
               });
  return sharpen(arriving, after_round);
}

std::optional<ReturnMaps> OrbitPursuit::maps_of(const Attempts& attempts,
                                                const std::vector<std::uint32_t>& lengths,
                                                bool with_derivatives,
                                                const RoundCallback& after_round) {
  std::vector<std::size_t> positions;
  std::vector<double> guesses;
  for (const OrbitAttempt* attempt : attempts) {
    positions.push_back(attempt->position);
    guesses.insert(guesses.end(), attempt->newton.state.begin(), attempt->newton.state.end());
  }
  const Tile part = part_of(plan_, tile_, positions, 1);
  return engine_->return_maps(plan_, part, guesses, lengths, with_derivatives, after_round);
}

// A step of Newton's method for each.
bool OrbitPursuit::step(const Attempts& attempts, const RoundCallback& after_round) {
  const std::optional<ReturnMaps> maps = maps_of(attempts, lengths_of(attempts), true, after_round);
  if (!maps) return false;
  for_each_on_all_cores(attempts.size(), [&](std::size_t i) {
    OrbitAttempt& attempt = *attempts[i];
    const double* derivative = maps->derivatives.data() + i * states_ * states_;
    attempt.verdict = newton_step(maps->states.data() + i * states_, derivative, limits_, tangents_,
                                  &attempt.newton);
    if (attempt.verdict == NewtonVerdict::close) {
      attempt.derivative.assign(derivative, derivative + states_ * states_);
    }
  });
  return true;
}

// Whether those that came close come back.
bool OrbitPursuit::confirm(const Attempts& close, const RoundCallback& after_round) {
  if (close.empty()) return true;
  const std::optional<ReturnMaps> maps = maps_of(close, lengths_of(close), false, after_round);
  if (!maps) return false;
  for_each_on_all_cores(close.size(), [&](std::size_t i) {
    close[i]->verdict = newton_confirm(maps->states.data() + i * states_,
                                       close[i]->derivative.data(), limits_, &close[i]->newton);
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
        if (!comes_back(maps->states.data() + i * states_, limits_, attempt.newton)) continue;
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

// Goes on with each trajectory until it is seen whether it converges to the orbit.
bool OrbitPursuit::follow(Attempts found, std::size_t most_periods,
                          const RoundCallback& after_round) {
  using Verdict = OrbitConvergence::Verdict;
  std::vector<OrbitConvergence> views;
  std::vector<std::vector<double>> ends;
  for (const OrbitAttempt* attempt : found) {
    views.push_back(convergence_to(*attempt, limits_));
    views.back().add(attempt->newton.start.data());
    ends.push_back(attempt->newton.start);
  }
  for (std::size_t gone = 0; gone + ORBIT_LONGEST <= most_periods && !found.empty();
       gone += ORBIT_LONGEST) {
    std::vector<std::size_t> positions;
    std::vector<double> states;
    for (std::size_t i = 0; i < found.size(); ++i) {
      positions.push_back(found[i]->position);
      states.insert(states.end(), ends[i].begin(), ends[i].end());
    }
    const Tile part = part_of(plan_, tile_, positions, ORBIT_LONGEST);
    const std::optional<std::vector<double>> sections =
        engine_->follow(plan_, part, states, after_round);
    if (!sections) return false;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double* own = sections->data() + i * ORBIT_LONGEST * states_;
      Verdict verdict = Verdict::open;
      for (std::size_t k = 1; k <= ORBIT_LONGEST && verdict == Verdict::open; ++k) {
        if ((gone + k) % found[i]->length != 0) continue;
        verdict = views[i].add(own + (k - 1) * states_);
      }
      found[i]->arrives = verdict == Verdict::converges;
      if (verdict != Verdict::open) continue;
      const double* last = own + (ORBIT_LONGEST - 1) * states_;
      ends[kept].assign(last, last + states_);
      found[kept] = found[i];
      if (kept != i) views[kept] = std::move(views[i]);
      ++kept;
    }
    found.resize(kept);
  }
  return true;
}

// Exponents are the multipliers of the orbit itself, not of a state that is near it by more than
// what counts as the same.
bool OrbitPursuit::sharpen(const Attempts& arriving, const RoundCallback& after_round) {
  if (arriving.empty()) return true;
  const std::optional<ReturnMaps> maps = maps_of(arriving, lengths_of(arriving), true, after_round);
  if (!maps) return false;
  for_each_on_all_cores(arriving.size(), [&](std::size_t i) {
    NewtonTry last = arriving[i]->newton;
    last.distance = std::numeric_limits<double>::infinity();
    const NewtonVerdict verdict =
        newton_step(maps->states.data() + i * states_,
                    maps->derivatives.data() + i * states_ * states_, limits_, tangents_, &last);
    arriving[i]->arrives = verdict == NewtonVerdict::close;
    arriving[i]->newton = std::move(last);
  });
  return true;
}

}  // namespace gearsweep
