#include "sweep/pilot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/error.hpp"
#include "sweep/sweep.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxValues = 12;  // of each axis
constexpr double kLongestStep = 0.2;
constexpr double kShortestStep = kLongestStep / 256.0;
constexpr double kShare = 0.95;           // of the points must agree
constexpr std::size_t kFewestPoints = 3;  // that a verdict can rest on
// Enough for a period of ORBIT_LONGEST to be seen.
constexpr std::size_t kRecord = 4 * ORBIT_LONGEST;

// Each point of the sub-grid on its own, all states sampled.
Study pilot_study(const Study& study) {
  Study pilot = study;
  for (Axis& axis : pilot.axes) axis.values = thin(axis.values, kMaxValues);
  if (pilot.is_chained()) pilot.initial.policy = InitialPolicy::shifted;
  pilot.initial.ensemble = 1;
  pilot.integrate.tolerance = 0.0;
  pilot.integrate.stop = Stop::orbit;
  pilot.integrate.record = kRecord;
  std::vector<std::string> states;
  for (const ChannelInfo& state : study.model->states) states.push_back(state.name);
  std::vector<std::string> quantities = {states.front() + "_rms", "period", "poincare"};
  for (const std::string& state : states) {
    quantities.push_back(state + "_min");
    quantities.push_back(state + "_max");
  }
  const double period_tolerance = pilot.selection.period_tolerance;
  pilot.selection = select_quantities(*study.model, quantities, states);
  pilot.selection.period_tolerance = period_tolerance;
  return pilot;
}

// One point of a pilot's result.
struct Orbit {
  std::size_t period = 0;  // 0: not on an orbit
  double rms = 0.0;
  std::vector<double> ranges;       // [state] of the motion, the largest among states of its unit
  const double* samples = nullptr;  // [state][sample]
};

// Where little moves about a large offset, a range is so large that a difference of the tolerance
// is 64 roundings.
std::vector<double> ranges_at(const SweepResult& result, double tolerance, std::size_t point) {
  const double rounding = result.study.integrate.fp64 ? std::numeric_limits<double>::epsilon()
                                                      : std::numeric_limits<float>::epsilon();
  const std::vector<ChannelInfo>& states = result.study.model->states;
  std::vector<double> ranges(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double low = map_of(result, states[i].name + "_min")[point];
    const double high = map_of(result, states[i].name + "_max")[point];
    const double min = 64.0 * rounding / tolerance * std::max(std::abs(low), std::abs(high));
    const double own = std::max(high - low, min);
    for (std::size_t j = 0; j < states.size(); ++j) {
      if (states[j].unit == states[i].unit) ranges[j] = std::max(ranges[j], own);
    }
  }
  return ranges;
}

Orbit orbit_of(const SweepResult& result, double tolerance, std::size_t point) {
  if (result.status[point] != STATUS_ok) return {};
  const std::size_t numbers = result.samples.size() / result.status.size();
  const std::string rms = result.study.model->states.front().name + "_rms";
  return {static_cast<std::size_t>(map_of(result, "period")[point]), map_of(result, rms)[point],
          ranges_at(result, tolerance, point), result.samples.data() + point * numbers};
}

// What is nothing beside nothing is no error.
double share_of(double difference, double range) {
  return difference > 0.0 ? difference / range : 0.0;
}

// Largest difference of two orbits of the same period, which may be out of phase by some turns.
double section_difference(const Orbit& a, const Orbit& b) {
  double min = std::numeric_limits<double>::infinity();
  for (std::size_t shift = 0; shift < a.period; ++shift) {
    double max = 0.0;
    for (std::size_t state = 0; state < a.ranges.size(); ++state) {
      for (std::size_t i = 0; i < a.period; ++i) {
        const double difference =
            std::abs(a.samples[state * kRecord + i] - b.samples[state * kRecord + i + shift]);
        max = std::max(max, share_of(difference, a.ranges[state]));
      }
    }
    min = std::min(min, max);
  }
  return min;
}

// The differences of the points that are on an orbit of the same period in both.
std::vector<double> differences(const SweepResult& a, const SweepResult& b, double tolerance) {
  std::vector<double> out;
  for (std::size_t point = 0; point < a.status.size(); ++point) {
    const Orbit one = orbit_of(a, tolerance, point);
    const Orbit other = orbit_of(b, tolerance, point);
    if (one.period == 0 || one.period > ORBIT_LONGEST || one.period != other.period) continue;
    const double rms =
        share_of(std::abs(one.rms - other.rms), std::min(one.rms, one.ranges.front()));
    out.push_back(std::max(section_difference(one, other), rms));
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

std::optional<SteppedStudy> choose_step(const Study& study, const SweepOptions& options) {
  const double tolerance = study.integrate.tolerance;
  if (tolerance == 0.0) return SteppedStudy{study, std::nullopt};
  const Study pilot = pilot_study(study);
  std::optional<SweepResult> coarse = run_with_step(pilot, kLongestStep, options);
  if (!coarse) return std::nullopt;
  double error = 0.0;
  for (double step = kLongestStep; step > kShortestStep; step /= 2.0) {
    std::optional<SweepResult> fine = run_with_step(pilot, step / 2.0, options);
    if (!fine) return std::nullopt;
    const std::vector<double> found = differences(*coarse, *fine, tolerance);
    if (found.size() >= kFewestPoints) {
      error = quantile(found, kShare);
      if (error <= tolerance) {
        SteppedStudy stepped{study, PilotFindings{step, error, found.size()}};
        stepped.study.integrate.max_step = step;
        return stepped;
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
