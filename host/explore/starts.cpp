#include "explore/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "model/error.hpp"
#include "plan/study_points.hpp"
#include "point/point_trace.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

// Of the motion whose size is looked at.
constexpr std::size_t kPeriods = 32, kSamplesPerPeriod = 32;

// How far each state goes in the motion from the study's own start; nothing where it diverges.
std::optional<std::vector<double>> size_of_motion(const Study& study,
                                                  const std::vector<NamedValue>& at,
                                                  const SweepOptions& options) {
  const TraceWindows windows = {std::nullopt, kPeriods};
  PointTraces found;
  try {
    if (!add_point_trace(with_windows(study, windows), find_place(study, at, ""), windows,
                         kSamplesPerPeriod, options, &found)) {
      return std::nullopt;
    }
  } catch (const RunError&) {
    return std::nullopt;
  }
  std::vector<double> size;
  for (std::size_t state = 0; state < study.model->states.size(); ++state) {
    const auto [low, high] = std::ranges::minmax(found.traces.front().values[state]);
    size.push_back(high - low);
  }
  return size;
}

// The starts of an ensemble of the study, which has one point: [start][state].
std::vector<std::vector<double>> starts_of(Study study, std::size_t count,
                                           const std::vector<double>& spread) {
  study.initial.ensemble = count;
  study.initial.spread = spread;
  const StudyPoints points(std::make_shared<const Study>(std::move(study)));
  std::vector<std::vector<double>> starts;
  for (std::size_t i = 0; i < count; ++i) starts.push_back(points.start(i));
  return starts;
}

// Points with a start of each their own, and the same values of what the study's axes sweep: so
// they need no other kernels than its maps.
Axis list_of(const Study& study, const std::vector<std::vector<double>>& starts) {
  Axis list;
  list.name = kPointAxis;
  list.is_list = true;
  for (std::size_t i = 0; i < starts.size(); ++i) list.values.push_back(static_cast<double>(i + 1));
  for (const Axis& axis : study.axes) {
    if (axis.is_state) continue;
    Swept column = axis;
    column.values.assign(starts.size(), axis.values.front());
    list.columns.push_back(std::move(column));
  }
  for (std::size_t state = 0; state < study.model->states.size(); ++state) {
    Swept column;
    column.name = study.model->states[state].name;
    column.is_state = true;
    column.index = state;
    for (const std::vector<double>& start : starts) column.values.push_back(start[state]);
    list.columns.push_back(std::move(column));
  }
  return list;
}

// Two of one kind differ in their size.
std::string name_of(const Attractor& attractor, const Model& model) {
  const std::string kind = motion_names().at(attractor.motion);
  const std::string period =
      attractor.period == 0.0 ? "" : fmt::format(", period {}", attractor.period);
  return fmt::format("{}{}, rms of {} {:.4g}", kind, period, model.states.front().name,
                     attractor.rms);
}

std::vector<std::vector<double>> section_of(const SweepResult& result, std::size_t point) {
  const std::size_t states = result.study.selection.poincare.size();
  std::vector<std::vector<double>> section(result.study.integrate.record);
  for (std::size_t state = 0; state < states; ++state) {
    const std::vector<double> samples = samples_of(result, point, state);
    for (std::size_t i = 0; i < section.size(); ++i) section[i].push_back(samples[i]);
  }
  std::erase_if(section, [](const std::vector<double>& sample) {
    return std::ranges::any_of(sample, [](double value) { return std::isnan(value); });
  });
  return section;
}

ReachedAttractors reached(const SweepResult& result) {
  const std::vector<double>& number = map_of(result, "attractor");
  const double share = 1.0 / static_cast<double>(number.size());
  ReachedAttractors out;
  std::map<double, ReachedAttractor> by_number;
  for (std::size_t point = 0; point < number.size(); ++point) {
    if (!has_values(result.status[point])) {
      out.diverged += share;
    } else if (number[point] == 0.0) {
      out.undecided += share;
    } else {
      ReachedAttractor& attractor = by_number[number[point]];
      attractor.share += share;
      if (!attractor.section.empty()) continue;
      attractor.name = name_of(result.attractors.at(static_cast<std::size_t>(number[point]) - 1),
                               *result.study.model);
      attractor.section = section_of(result, point);
    }
  }
  for (auto& [its_number, attractor] : by_number) out.attractors.push_back(std::move(attractor));
  std::ranges::sort(out.attractors, std::greater(), &ReachedAttractor::share);
  return out;
}

}  // namespace

std::optional<ReachedAttractors> look_at_starts(const Scene& scene, const Cell& cell,
                                                std::size_t starts, const SweepOptions& options) {
  Study study = scene.census();
  std::vector<NamedValue> at;
  for (std::size_t i = 0; i < 2; ++i) {
    study.axes[i].values = {scene.value_at(i, cell.k[i], cell.depth)};
    at.push_back({study.axes[i].name, study.axes[i].values.front()});
  }
  const std::optional<std::vector<double>> size = size_of_motion(study, at, options);
  // In a box that reaches as far to either side as the motion goes from end to end.
  study.axes = {list_of(study, starts_of(study, starts, size.value_or(study.initial.spread)))};
  const std::optional<SweepResult> result = run_sweep(study, options);
  if (!result) return std::nullopt;
  return reached(*result);
}

}  // namespace gearsweep
