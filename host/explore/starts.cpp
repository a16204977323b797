#include "explore/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "explore/state_ranges.hpp"
#include "plan/study_points.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

// To either side of the point's own start: as far as the motion from there goes from end to end.
std::vector<double> spread_of(const Study& point) {
  std::vector<double> spread;
  for (const StateRange& range : state_ranges(point)) {
    spread.push_back(0.5 * (range.high - range.low));
  }
  return spread;
}

// The starts of an ensemble at the study's one point, whose own may be on its axes: [start][state].
std::vector<std::vector<double>> starts_of(Study study, std::size_t count,
                                           const std::vector<double>& spread) {
  study.initial.state = StudyPoints(std::make_shared<const Study>(study)).start(0);
  study.initial.policy = InitialPolicy::fixed;
  std::erase_if(study.axes, [](const Axis& axis) { return axis.is_state; });
  if (study.axes.empty()) study.axes.push_back(resting_axis(study));
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

// Two of one kind differ in their size, or in their place.
std::string name_of(const Attractor& attractor, const std::vector<std::vector<double>>& section,
                    const Model& model) {
  const std::string kind = motion_names().at(attractor.motion);
  const std::string period =
      attractor.period == 0.0 ? "" : fmt::format(", period {}", attractor.period);
  const std::string& state = model.states.front().name;
  std::string text = fmt::format("{}{}, rms of {} {:.4g}", kind, period, state, attractor.rms);
  if (section.empty()) return text;
  double sum = 0.0;
  for (const std::vector<double>& sample : section) sum += sample.front();
  return text + fmt::format(", at its section {:.4g} on average",
                            sum / static_cast<double>(section.size()));
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
      attractor.section = section_of(result, point);
      attractor.name = name_of(result.attractors.at(static_cast<std::size_t>(number[point]) - 1),
                               attractor.section, *result.study.model);
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
  for (std::size_t i = 0; i < 2; ++i) {
    study.axes[i].values = {scene.value_at(i, cell.k[i], cell.depth)};
  }
  study.axes = {list_of(study, starts_of(study, starts, spread_of(study)))};
  const std::optional<SweepResult> result = run_sweep(study, options);
  if (!result) return std::nullopt;
  return reached(*result);
}

}  // namespace gearsweep
