#include "distribute/pilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

constexpr std::size_t kMostValues = 12;  // of each axis
constexpr double kLongestStep = 0.2;
constexpr double kShortestStep = kLongestStep / 256.0;
constexpr double kShare = 0.95;           // of the points must agree
constexpr std::size_t kFewestPoints = 3;  // that a verdict can rest on
// Enough for a period of ORBIT_LONGEST to be seen.
constexpr std::size_t kRecord = 4 * ORBIT_LONGEST;

// Each point of the sub-grid on its own, all states sampled.
Study pilot_study(const Study& study) {
  Study pilot = study;
  for (Axis& axis : pilot.axes) axis.values = thin(axis.values, kMostValues);
  if (pilot.is_chained()) pilot.initial.policy = InitialPolicy::shifted;
  pilot.initial.ensemble = 1;
  pilot.integrate.tolerance = 0.0;
  pilot.integrate.stop = Stop::orbit;
  pilot.integrate.record = kRecord;
  std::vector<std::string> states;
  for (const ChannelInfo& state : study.model->states) states.push_back(state.name);
  const double period_tolerance = pilot.selection.period_tolerance;
  pilot.selection =
      select_quantities(*study.model, {states.front() + "_rms", "period", "poincare"}, states);
  pilot.selection.period_tolerance = period_tolerance;
  return pilot;
}

// One point of a pilot's result.
struct Orbit {
  std::size_t period = 0;  // 0: not on an orbit
  double rms = 0.0;
  const double* samples = nullptr;  // [state][sample]
};

Orbit orbit_of(const SweepResult& result, std::size_t point) {
  if (result.status[point] != STATUS_ok) return {};
  const std::size_t numbers = result.samples.size() / result.status.size();
  return {static_cast<std::size_t>(result.values[1][point]), result.values[0][point],
          result.samples.data() + point * numbers};
}

// Greatest difference of two orbits of the same period, which may be out of phase by some turns.
double section_difference(const Orbit& a, const Orbit& b, std::size_t states) {
  double scale = 0.0;
  for (std::size_t i = 0; i < states * kRecord; ++i)
    scale = std::max(scale, std::abs(a.samples[i]));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t shift = 0; shift < a.period; ++shift) {
    double greatest = 0.0;
    for (std::size_t state = 0; state < states; ++state) {
      for (std::size_t i = 0; i < a.period; ++i) {
        greatest = std::max(greatest, std::abs(a.samples[state * kRecord + i] -
                                               b.samples[state * kRecord + i + shift]));
      }
    }
    least = std::min(least, greatest);
  }
  return scale > 0.0 ? least / scale : least;
}

// The differences of the points that are on an orbit of the same period in both.
std::vector<double> differences(const SweepResult& a, const SweepResult& b) {
  const std::size_t states = a.study.model->states.size();
  std::vector<double> out;
  for (std::size_t point = 0; point < a.status.size(); ++point) {
    const Orbit one = orbit_of(a, point);
    const Orbit other = orbit_of(b, point);
    if (one.period == 0 || one.period > ORBIT_LONGEST || one.period != other.period) continue;
    const double rms = std::abs(one.rms - other.rms);
    out.push_back(
        std::max(section_difference(one, other, states), one.rms > 0.0 ? rms / one.rms : rms));
  }
  return out;
}

double quantile(std::vector<double> values, double share) {
  const auto index =
      static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size())) - 1.0);
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

std::optional<SweepResult> run_with_step(Study pilot, double step, const SweepOptions& options) {
  pilot.integrate.max_step = step;
  SweepOptions own;
  own.devices = options.devices;
  own.stop = options.stop;
  return run_sweep(pilot, own);
}

}  // namespace

std::vector<double> thin(const std::vector<double>& values, std::size_t count) {
  if (values.size() <= count) return values;
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(values[count == 1 ? 0 : i * (values.size() - 1) / (count - 1)]);
  }
  return out;
}

std::optional<PilotRun> find_step(const Study& study, const SweepOptions& options) {
  const double tolerance = study.integrate.tolerance;
  const Study pilot = pilot_study(study);
  std::optional<SweepResult> coarse = run_with_step(pilot, kLongestStep, options);
  if (!coarse) return std::nullopt;
  double error = 0.0;
  for (double step = kLongestStep; step > kShortestStep; step /= 2.0) {
    std::optional<SweepResult> fine = run_with_step(pilot, step / 2.0, options);
    if (!fine) return std::nullopt;
    const std::vector<double> found = differences(*coarse, *fine);
    if (found.size() >= kFewestPoints) {
      error = quantile(found, kShare);
      if (error <= tolerance) {
        PilotRun run{study, {step, error, found.size()}};
        run.study.integrate.max_step = step;
        return run;
      }
    }
    coarse = std::move(fine);
  }
  if (error == 0.0) {
    throw InputError(fmt::format(
        "integrate.tolerance: of the pilot's {} points fewer than {} arrive on a periodic orbit "
        "within integrate.settle periods, so they do not tell what a step costs; give "
        "integrate.max_step instead",
        coarse->status.size(), kFewestPoints));
  }
  throw InputError(fmt::format(
      "integrate.tolerance = {}: steps of {:.3g} leave {:.2g}; ask for more than that{}, or give "
      "integrate.max_step",
      tolerance, 2.0 * kShortestStep, error,
      study.integrate.fp64 ? "" : " (fp32 has no more digits; fp64 may)"));
}

}  // namespace gearsweep
