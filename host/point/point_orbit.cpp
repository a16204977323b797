#include "point/point_orbit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/error.hpp"
#include "orbits/find_orbit.hpp"
#include "orbits/require_multipliers.hpp"
#include "plan/plan.hpp"
#include "study/own_step.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

// The place with the start of the range, unless it or the study's point has its own.
Place start_of(const Study& whole, const OrbitRequest& request) {
  Place place = request.place;
  if (!request.range) return place;
  const std::size_t parameter = request.range->parameter;
  const bool is_column = std::ranges::any_of(whole.axes, [&](const Axis& axis) {
    return !axis.columns.empty() && is_swept(axis, {false, parameter, 0.0});
  });
  if (is_column) return place;
  const bool is_placed = std::any_of(
      place.values.begin(), place.values.end(),
      [&](const Placed& placed) { return !placed.is_state && placed.index == parameter; });
  if (!is_placed) place.values.push_back({false, parameter, request.range->from});
  return place;
}

void require_start_in(const OrbitRequest& request, const Study& study) {
  const FollowedRange& range = *request.range;
  const double start = study.setting.parameters[range.parameter];
  if (start >= std::min(range.from, range.to) && start <= std::max(range.from, range.to)) return;
  throw InputError(told_of(
      request.place.origin,
      fmt::format("{} = {} is not in the range of {}",
                  study.model->parameters[range.parameter].name, start, request.range_origin)));
}

// The study of the one point where the orbit is looked for; it samples the whole state at the end.
Study settling_study(const Study& whole, const OrbitRequest& request, const Place& place) {
  Study study = whole;
  place_parameters(place, &study);
  if (request.range) require_start_in(request, study);
  place_states(place, &study);
  study.selection = select_quantities(*study.model, {"poincare"}, study.model->state_names());
  study.integrate.record = 1;
  return study;
}

// The parameters of the point: those of the axes, then the others of the place.
std::vector<std::size_t> parameters_of(const Study& study, const Place& place) {
  std::vector<std::size_t> all;
  const auto add = [&](std::size_t parameter) {
    if (std::find(all.begin(), all.end(), parameter) == all.end()) all.push_back(parameter);
  };
  for (const Swept* swept : study.swept()) {
    if (!swept->is_state) add(swept->index);
  }
  for (const Placed& placed : place.values) {
    if (!placed.is_state) add(placed.index);
  }
  for (const DerivedParameter& derived : study.model->derived) {
    if (std::ranges::any_of(derived.from, [&](std::size_t from) {
          return std::ranges::find(all, from) != all.end();
        })) {
      add(derived.parameter);
    }
  }
  return all;
}

Eigen::VectorXd vector_of(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(),
                                           static_cast<Eigen::Index>(numbers.size()));
}

// Where the engine's trajectory is after the study's settling periods.
std::optional<Eigen::VectorXd> end_state(const Study& study, const SweepOptions& options) {
  const std::optional<SweepResult> result = run_sweep(study, options);
  if (!result) return std::nullopt;
  const Eigen::VectorXd state = vector_of(result->samples);
  if (!state.allFinite())
    throw RunError("the trajectory diverged: there is no orbit to start from");
  return state;
}

// The orbit of a model without a phase.
Orbit find_free(const PeriodMap& map, const Eigen::VectorXd& start, const Eigen::VectorXd& settled,
                const CycleSearch& search) {
  if (!search.period) {
    if (const std::optional<Orbit> rest = find_rest(map, start, settled)) return *rest;
  }
  return find_cycle(map, settled, search);
}

// A cycle with steps that are short enough for its multiplier along itself to be 1, within reason,
// and while that helps.
Orbit refined(const PeriodMap& map, Orbit cycle) {
  constexpr double kNearOne = 1e-9;
  constexpr int kMaxDoublings = 3;
  for (int doublings = 0; doublings < kMaxDoublings && cycle.along; ++doublings) {
    if (std::fabs(*cycle.along - 1.0) < kNearOne) break;
    std::optional<Orbit> finer = shoot_again(map, cycle, 2 * cycle.steps);
    if (!finer || std::fabs(*finer->along - 1.0) > 0.5 * std::fabs(*cycle.along - 1.0)) break;
    cycle = *std::move(finer);
  }
  return cycle;
}

Orbit find_unstable_rest(const PeriodMap& map, const Eigen::VectorXd& start) {
  if (const std::optional<Orbit> rest = find_equilibrium(map, start)) return *rest;
  throw RunError(
      "Newton's method found no equilibrium: try a start that is nearer to one (states in --at)");
}

void require_free(const PeriodMap& map, const Model& model) {
  if (!map.driven()) return;
  throw InputError(
      fmt::format("model '{}' is driven: it has no equilibria, but orbits of the forcing's period",
                  model.name));
}

void follow(const OrbitRequest& asked, const PeriodMap& map, const std::atomic<bool>* stop,
            OrbitFindings* findings) {
  const Study& study = findings->study;
  const FollowedRange& range = *asked.range;
  FollowRequest request = {study.model,
                           study.setting,
                           range.parameter,
                           std::min(range.from, range.to),
                           std::max(range.from, range.to),
                           map.steps(),
                           false,
                           stop,
                           asked.each_orbit};
  const double start = study.setting.parameters[range.parameter];
  const Orbit first = away_from_surfaces(map, findings->orbit);
  std::vector<Branch>& branches = findings->branches;
  if (start > request.from) branches.push_back(follow_orbit(request, first));
  request.upwards = true;
  if (start < request.to) branches.push_back(follow_orbit(request, first));
  findings->leaving = follow_leaving(request, branches, asked.generations);
  findings->generations = asked.generations;
}

}  // namespace

FollowedRange find_range(const Model& model, const std::string& name, double from, double to,
                         const std::string& origin) {
  const FollowedRange range = {parameter_index(model, name, origin), from, to};
  for (const double value : {from, to}) {
    require_in_range(model.parameters[range.parameter], value, origin);
  }
  if (from == to) throw InputError(told_of(origin, "the range is empty"));
  if (!model.uses_parameter(name)) {
    throw InputError(told_of(
        origin, fmt::format("nothing in model '{}' depends on '{}': there is nothing to follow",
                            model.name, name)));
  }
  return range;
}

std::optional<OrbitFindings> find_point_orbit(const Study& whole, const OrbitRequest& request,
                                              const SweepOptions& options) {
  const Place place = start_of(whole, request);
  const Study study = settling_study(whole, request, place);
  const Model& model = *study.model;
  require_multipliers(study);
  const Plan plan(study, 1);
  const std::size_t own_steps = plan.steps_of(0);
  const std::size_t steps = request.steps.value_or(std::max(kMinOrbitSteps, own_steps));
  const PeriodMap map(model, study.setting, steps, options.stop);
  const Eigen::VectorXd start = vector_of(plan.own_initial_state(0));
  std::optional<Eigen::VectorXd> settled;
  if (request.is_equilibrium) {
    require_free(map, model);
  } else {
    settled = end_state(study, options);
    if (!settled) return std::nullopt;
  }
  try {
    Orbit orbit;
    if (request.is_equilibrium) {
      orbit = find_unstable_rest(map, start);
    } else if (map.driven()) {
      orbit = find_orbit(map, *settled, request.period);
    } else {
      // A step that was found for all points may be much too short for this one.
      const double step = study.step_reason.empty() ? map.period() / static_cast<double>(own_steps)
                                                    : find_own_step(study).longest;
      orbit = find_free(map, start, *settled, {step, steps, request.period});
      if (!request.steps) orbit = refined(map, std::move(orbit));
    }
    const OrbitError error =
        error_of(orbit, PeriodMap(model, study.setting, map.steps() / 2, options.stop));
    OrbitFindings findings{
        study, parameters_of(study, place), map.period(), orbit, error, request.range, {}};
    if (request.range) follow(request, map, options.stop, &findings);
    return findings;
  } catch (const SearchStopped&) {
    return std::nullopt;
  }
}

}  // namespace gearsweep
