#include "study/own_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "equations/field_graph.hpp"
#include "study/detail/probe_motion.hpp"

namespace gearsweep {
namespace {

constexpr double kLocalError = 1e-7, kLocalErrorOfTransient = 1e-5;  // of each state's range
// Where steps are cut at surfaces: each return cuts them elsewhere, so that a cycle's returns
// differ by what its steps are wrong by, and not by what that changes by.
constexpr double kLocalErrorOfCuts = 1e-8;
constexpr double kRate = 0.3, kRateOfTransient = 2.0;  // times the step
// Of the range of a surface's level, at its fastest, in a step: 20 steps in a turn of a sine. Where
// a level goes there and back within a step, both crossings are missed.
constexpr double kLevelWay = 0.15;
constexpr std::size_t kSteps = 1000;  // of either half of a motion

struct ProbeStart {
  ModelSetting setting;
  std::vector<double> state;
};

// Corners and middle of two axes, five places of one.
std::vector<ProbeStart> probe_starts(const Study& study) {
  const std::size_t places = study.axes.size() == 1 ? 5 : 3;
  std::vector<std::vector<std::size_t>> chosen(2, std::vector<std::size_t>{0});
  for (std::size_t axis = 0; axis < study.axes.size(); ++axis) {
    const std::size_t count = study.axes[axis].values.size();
    chosen[axis].clear();
    for (std::size_t i = 0; i < places; ++i) chosen[axis].push_back(i * (count - 1) / (places - 1));
    chosen[axis].erase(std::unique(chosen[axis].begin(), chosen[axis].end()), chosen[axis].end());
  }
  std::vector<ProbeStart> starts;
  for (const std::size_t second : chosen[1]) {
    for (const std::size_t first : chosen[0]) {
      const std::size_t index[] = {first, second};
      ProbeStart start = {study.setting, {}};
      std::vector<std::pair<std::size_t, double>> states;
      for (std::size_t axis = 0; axis < study.axes.size(); ++axis) {
        for (const Swept& swept : study.axes[axis].swept()) {
          const double value = swept.values[index[axis]];
          if (swept.is_state) {
            states.emplace_back(swept.index, value);
          } else {
            start.setting.parameters[swept.index] = value;
          }
        }
      }
      // The plan refuses what is wrong here.
      if (!study.model->check(start.setting).empty()) continue;
      start.state = study.initial.policy == InitialPolicy::fixed
                        ? study.initial.state
                        : study.model->equilibrium(start.setting);
      for (const auto& [state, value] : states) start.state[state] = value;
      starts.push_back(std::move(start));
    }
  }
  return starts;
}

// The shortest of the steps that are asked for, and who asks.
struct Shortest {
  double step = std::numeric_limits<double>::infinity();
  std::string reason;

  void take(double other, const std::string& why) {
    if (!(other < step)) return;
    step = other;
    reason = why;
  }
};

void ask_motion(const Study& study, const ProbeStart& start, Shortest* shortest) {
  ProbeMotion motion(*study.model, start.setting, start.state);
  const ProbeMotion::Stretch transient = motion.go_on(kSteps);
  if (!study.model->is_autonomous) {
    shortest->take(motion.period() / ProbeMotion::kForcedSteps,
                   "16 steps for each period of the forcing");
  }
  const ProbeMotion::Stretch later = motion.go_on(kSteps);
  // On its way to infinity it gets faster and faster.
  if (motion.escapes()) {
    return shortest->take(kRate / transient.first_rate,
                          fmt::format("the start has a rate of {:.3g}", transient.first_rate));
  }
  const double local_error = study.model->surfaces.empty() ? kLocalError : kLocalErrorOfCuts;
  const std::string error =
      fmt::format("the error of a step is {} of each state's range", local_error);
  shortest->take(transient.step_of(kLocalErrorOfTransient), error);
  shortest->take(kRateOfTransient / transient.rate,
                 fmt::format("the transient has a rate of {:.3g}", transient.rate));
  shortest->take(later.step_of(local_error), error);
  shortest->take(kRate / later.rate, fmt::format("the motion has a rate of {:.3g}", later.rate));
  const double level_time = later.level_time(*study.model);
  shortest->take(kLevelWay * level_time,
                 fmt::format("a jump or a surface is passed in a time of {:.3g}", level_time));
}

// The longest that is no longer than `step` and divides the period into a number of the ladder.
double rounded_down(double step, double period) { return period / rounded_up(period / step); }

}  // namespace

double rounded_up(double steps) {
  const double octave = std::exp2(std::floor(std::log2(steps)));
  return octave / 4.0 * std::ceil(4.0 * steps / octave - 1e-9);
}

OwnStep find_own_step(const Study& study) {
  const std::vector<ProbeStart> starts = probe_starts(study);
  Shortest shortest;
  for (const ProbeStart& start : starts) ask_motion(study, start, &shortest);
  if (starts.empty()) return {1.0, 1.0, "no point can be computed"};
  const double period = study.model->period(starts.front().setting);
  if (!std::isfinite(shortest.step)) {
    const bool is_defined = std::ranges::all_of(starts, [&](const ProbeStart& start) {
      return ProbeMotion(*study.model, start.setting, start.state).has_finite_rates();
    });
    const double step = period / ProbeMotion::kForcedSteps;
    return {step, step,
            is_defined ? "nothing in the motion limits it"
                       : "the equations are not finite at the start"};
  }
  return {rounded_down(shortest.step, period), shortest.step, shortest.reason};
}

// How far the states range in a stretch, in the largest of the ranges in `widest`, which it widens.
double extent_of(const ProbeMotion::Stretch& stretch, std::vector<double>* widest) {
  widest->resize(stretch.low.size(), 0.0);
  double extent = 0.0;
  for (std::size_t i = 0; i < stretch.low.size(); ++i) {
    const double range = stretch.high[i] - stretch.low[i];
    (*widest)[i] = std::max((*widest)[i], range);
    if (range > stretch.rounding[i]) extent = std::max(extent, range / (*widest)[i]);
  }
  return extent;
}

double mean_return_time(const Study& study) {
  constexpr std::size_t kEnough = 8, kSome = 2;
  constexpr int kStretches = 8, kMostStretches = 200;
  constexpr double kAtRest = 1e-3;  // of the ranges that the motion has had
  std::vector<double> times;
  for (const ProbeStart& start : probe_starts(study)) {
    ProbeMotion motion(*study.model, start.setting, start.state);
    std::vector<double> widest;
    extent_of(motion.go_on(kSteps), &widest);
    const std::size_t before = motion.returns().size();
    const auto seen = [&] { return motion.returns().size() - before; };
    for (int i = 0; i < kMostStretches && seen() < kEnough; ++i) {
      if (i >= kStretches && seen() >= kSome) break;
      // A cycle may be slow beside its steps; but not where another motion has told.
      if (i >= kStretches && !times.empty()) break;
      const double extent = extent_of(motion.go_on(kSteps), &widest);
      if (motion.escapes() || (i >= kStretches && extent < kAtRest)) break;
    }
    if (motion.escapes() || seen() < kSome) continue;
    const double span = motion.returns().back() - motion.returns()[before];
    times.push_back(span / static_cast<double>(seen() - 1));
  }
  if (times.empty()) return 0.0;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::ranges::nth_element(times, middle);
  return *middle;
}

std::optional<std::size_t> better_state_to_look_at(const Study& study) {
  constexpr std::size_t kStretches = 8;
  constexpr double kStill = 0.1;  // of its range: a state that moves less at the end has swung out
  const Model& model = *study.model;
  std::vector<std::size_t> good(model.states.size(), 0);
  for (const ProbeStart& start : probe_starts(study)) {
    ProbeMotion motion(model, start.setting, start.state);
    motion.go_on(kSteps);
    motion.watch_peaks();
    ProbeMotion::Stretch all = motion.go_on(kSteps);
    ProbeMotion::Stretch last = all;
    for (std::size_t i = 1; i < kStretches && !motion.escapes(); ++i) {
      last = motion.go_on(kSteps);
      for (std::size_t j = 0; j < good.size(); ++j) {
        all.low[j] = std::min(all.low[j], last.low[j]);
        all.high[j] = std::max(all.high[j], last.high[j]);
      }
    }
    if (motion.escapes()) continue;
    const std::vector<bool> has_peaks = motion.has_peaks();
    for (std::size_t i = 0; i < good.size(); ++i) {
      const bool moves = last.high[i] - last.low[i] > kStill * (all.high[i] - all.low[i]);
      good[i] += has_peaks[i] && moves ? 1 : 0;
    }
  }
  for (const std::size_t angle : model.angles) good[angle] = 0;
  const auto is_looked_at = [&](std::size_t state) {
    return !model.field->graph.is_number(model.field->rates[state], 0.0) &&
           std::ranges::find(model.angles, state) == model.angles.end();
  };
  std::size_t own = 0;
  while (own + 1 < good.size() && !is_looked_at(own)) ++own;
  const auto best = std::ranges::max_element(good);
  if (*best == good[own]) return std::nullopt;
  return static_cast<std::size_t>(best - good.begin());
}

std::map<std::string, double> motion_ranges(const Study& study) {
  std::map<std::string, std::vector<double>> found;
  for (const ProbeStart& start : probe_starts(study)) {
    ProbeMotion motion(*study.model, start.setting, start.state);
    motion.go_on(kSteps);
    const ProbeMotion::Stretch later = motion.go_on(kSteps);
    if (motion.escapes()) continue;
    for (std::size_t i = 0; i < later.low.size(); ++i) {
      found[study.model->states[i].name].push_back(later.high[i] - later.low[i]);
    }
    for (std::size_t i = 0; i < later.low_signals.size(); ++i) {
      const double range = later.high_signals[i] - later.low_signals[i];
      if (std::isfinite(range)) found[study.model->signals[i].name].push_back(range);
    }
  }
  std::map<std::string, double> ranges;
  for (auto& [name, values] : found) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    ranges[name] = *middle;
  }
  return ranges;
}

}  // namespace gearsweep
