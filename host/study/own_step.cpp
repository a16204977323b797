#include "study/own_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "study/detail/median.hpp"
#include "study/detail/probe_motion.hpp"
#include "study/detail/probe_starts.hpp"

namespace gearsweep {
namespace {

constexpr double kLocalError = 1e-7, kLocalErrorOfTransient = 1e-5;  // of each state's range
// Where steps are cut at surfaces: each return cuts them elsewhere, so that a cycle's returns
// differ by what its steps are wrong by, and not by what that changes by.
constexpr double kLocalErrorOfCuts = 1e-8;
constexpr double kRate = 0.3, kRateOfTransient = 2.0;  // times the step
// A share of the range of a surface's level, the most that it goes in a step: 20 steps in a turn of
// a sine. Where
// a level goes there and back within a step, both crossings are missed.
constexpr double kLevelWay = 0.15;
constexpr std::size_t kSteps = 1000;       // of either half of a motion
constexpr std::size_t kStepsOfLook = 200;  // of a motion that has settled

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

void widen(const ProbeMotion::Stretch& stretch, MotionReach* reach) {
  if (reach->low.empty()) *reach = {stretch.low, stretch.high};
  for (std::size_t i = 0; i < reach->low.size(); ++i) {
    reach->low[i] = std::min(reach->low[i], stretch.low[i]);
    reach->high[i] = std::max(reach->high[i], stretch.high[i]);
  }
}

double local_error_of(const Model& model) {
  return model.surfaces.empty() ? kLocalError : kLocalErrorOfCuts;
}

void ask_motion(const Study& study, const ProbeStart& start, Shortest* shortest,
                MotionReach* reach) {
  ProbeMotion motion(*study.model, start.setting, start.state);
  const ProbeMotion::Stretch transient = motion.go_on(kSteps);
  widen(transient, reach);
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
  widen(later, reach);
  const double local_error = local_error_of(*study.model);
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
  MotionReach reach;
  for (const ProbeStart& start : starts) ask_motion(study, start, &shortest, &reach);
  if (starts.empty()) return {1.0, 1.0, "no point can be computed", {}};
  const double period = study.model->period(starts.front().setting);
  if (!std::isfinite(shortest.step)) {
    const bool is_defined = std::ranges::all_of(starts, [&](const ProbeStart& start) {
      return ProbeMotion(*study.model, start.setting, start.state).has_finite_rates();
    });
    const double step = period / ProbeMotion::kForcedSteps;
    return {step, step,
            is_defined ? "nothing in the motion limits it"
                       : "the equations are not finite at the start",
            reach};
  }
  return {rounded_down(shortest.step, period), shortest.step, shortest.reason, reach};
}

double step_of_error_at(const Model& model, const ModelSetting& setting,
                        const std::vector<double>& state) {
  ProbeMotion motion(model, setting, state);
  const ProbeMotion::Stretch stretch = motion.go_on(kStepsOfLook);
  return motion.escapes() ? 0.0 : stretch.step_of(local_error_of(model));
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
  for (const auto& [name, values] : found) {
    ranges[name] = median_of(values);
  }
  return ranges;
}

}  // namespace gearsweep
