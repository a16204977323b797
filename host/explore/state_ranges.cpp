#include "explore/state_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "model/error.hpp"
#include "plan/study_points.hpp"
#include "point/point_trace.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kLooked = 24, kLookedSamples = 16;  // periods, samples in each

// The study at the middle of its axes.
Study middle_of(Study study, std::vector<NamedValue>* at) {
  if (study.axes.empty()) study.axes.push_back(resting_axis(study));
  for (Axis& axis : study.axes) {
    axis.values = {axis.values[axis.values.size() / 2]};
    at->push_back({axis.name, axis.values.front()});
  }
  study.separate_points();
  study.integrate.engine = EngineKind::reference;
  return study;
}

// Beyond both ends by half of the way between them.
StateRange widened(double low, double high) {
  const double size = high > low ? 0.5 * (high - low) : low != 0.0 ? std::abs(low) : 1.0;
  return {low - size, high + size};
}

std::vector<StateRange> ranges_of(const Trace& trace, const std::vector<double>& start) {
  std::vector<StateRange> ranges;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const auto [low, high] = std::ranges::minmax(trace.values[i]);
    ranges.push_back(widened(std::min(low, start[i]), std::max(high, start[i])));
  }
  return ranges;
}

}  // namespace

std::vector<StateRange> state_ranges(const Study& study) {
  std::vector<NamedValue> at;
  try {
    Study middle = middle_of(study, &at);
    if (middle.integrate.max_step == 0.0) settle_step(std::nullopt, &middle);
    const TraceWindows windows = {1, kLooked};
    PointTraces found;
    if (add_point_trace(with_windows(middle, windows), find_place(middle, at, ""), windows,
                        kLookedSamples, {}, &found)) {
      const StudyPoints points(std::make_shared<const Study>(middle));
      return ranges_of(found.traces.front(), points.start(0));
    }
  } catch (const std::runtime_error&) {
    at.clear();
  }
  std::vector<StateRange> ranges;
  for (const double start : start_of_policy(study, study.setting)) {
    ranges.push_back(widened(start, start));
  }
  return ranges;
}

const std::vector<StateRange>& LateStateRanges::of(const Study& study) {
  std::call_once(is_found_, [&] {
    ranges_ = state_ranges(study);
    is_known_ = true;
  });
  return ranges_;
}

}  // namespace gearsweep
