// gearsweep floquet: the periodic orbit at one point of a study, its Floquet multipliers, and the
// bifurcations along a parameter.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/floquet_report.hpp"
#include "cli/detail/place.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "plan/plan.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMinSteps = 2048;  // per period, unless --steps says otherwise

struct FloquetArguments {
  std::string study, along;
  std::vector<std::string> at, overrides;
  std::string device;
  std::optional<std::size_t> period, steps;
  bool as_json = false;
};

FollowedRange read_range(const Model& model, const std::string& text) {
  const auto [name, values] = split_assignment(text, "--along", "omega=0.6:0.8");
  const std::size_t colon = values.find(':');
  if (colon == std::string::npos) {
    throw InputError(fmt::format("--along: '{}' is not of the form omega=0.6:0.8", text));
  }
  const FollowedRange range = {parameter_index(model, name, "--along"),
                               to_number(values.substr(0, colon), "--along"),
                               to_number(values.substr(colon + 1), "--along")};
  for (const double value : {range.from, range.to}) {
    require_in_range(model.parameters[range.parameter], value, "--along");
  }
  if (range.from == range.to) throw InputError("--along: the range is empty");
  return range;
}

void require_start_in(const FollowedRange& range, const Study& study) {
  const double start = study.setting.parameters[range.parameter];
  if (start >= std::min(range.from, range.to) && start <= std::max(range.from, range.to)) return;
  throw InputError(fmt::format("--at: {} = {} is not in the range of --along",
                               study.model->parameters[range.parameter].name, start));
}

// The study of the one point where the orbit is looked for; it samples the whole state at the end.
Study point_study(const Study& whole, const FloquetArguments& arguments,
                  const std::optional<FollowedRange>& range) {
  Study study = whole;
  std::vector<Placed> place = read_place(*study.model, arguments.at);
  const bool placed_along =
      range && std::any_of(place.begin(), place.end(), [&](const Placed& placed) {
        return !placed.is_state && placed.index == range->parameter;
      });
  if (range && !placed_along) place.push_back({false, range->parameter, range->from});
  place_parameters(place, &study);
  if (range) require_start_in(*range, study);
  place_states(place, &study);
  std::vector<std::string> states;
  for (const ChannelInfo& state : study.model->states) states.push_back(state.name);
  study.selection = select_quantities(*study.model, {"poincare"}, states);
  study.integrate.record = 1;
  return study;
}

// Where the engine's trajectory is after the study's settling periods.
Eigen::VectorXd end_state(const Study& study, const std::string& device) {
  SweepOptions options;
  options.devices = chosen_devices(device);
  const std::optional<SweepResult> result = run_sweep(study, options);
  const Eigen::VectorXd state = Eigen::Map<const Eigen::VectorXd>(
      result->samples.data(), static_cast<Eigen::Index>(result->samples.size()));
  if (!state.allFinite())
    throw RunError("the trajectory diverged: there is no orbit to start from");
  return state;
}

PeriodMap map_of(const Study& study, std::optional<std::size_t> steps) {
  const std::size_t of_study = Plan(study, 1).steps_of(0);
  PeriodMap map(*study.model, study.setting, steps.value_or(std::max(kMinSteps, of_study)));
  if (!map.driven()) {
    throw InputError(
        fmt::format("model '{}' is autonomous: floquet is for models that are driven periodically",
                    study.model->name));
  }
  return map;
}

std::vector<Branch> follow(const Study& study, const FollowedRange& range, const PeriodMap& map,
                           const Orbit& orbit) {
  FollowRequest request = {study.model,
                           study.setting,
                           range.parameter,
                           std::min(range.from, range.to),
                           std::max(range.from, range.to),
                           map.steps(),
                           false};
  const double start = study.setting.parameters[range.parameter];
  std::vector<Branch> branches;
  if (start > request.from) branches.push_back(follow_orbit(request, orbit));
  request.upwards = true;
  if (start < request.to) branches.push_back(follow_orbit(request, orbit));
  return branches;
}

FloquetFindings compute(const FloquetArguments& arguments) {
  const Study whole = load_study(arguments.study, arguments.overrides);
  std::optional<FollowedRange> range;
  if (!arguments.along.empty()) range = read_range(*whole.model, arguments.along);
  const Study study = point_study(whole, arguments, range);
  PeriodMap map = map_of(study, arguments.steps);
  const Orbit orbit = find_orbit(map, end_state(study, arguments.device), arguments.period);
  const OrbitError error = error_of(orbit, PeriodMap(*study.model, study.setting, map.steps() / 2));
  std::vector<Branch> branches;
  if (range) branches = follow(study, *range, map, orbit);
  return {study, std::move(map), orbit, error, range, std::move(branches)};
}

}  // namespace

void add_floquet_command(CLI::App* app) {
  CLI::App* command = app->add_subcommand(
      "floquet", "The periodic orbit at a point, its multipliers, and its bifurcations");
  const auto arguments = std::make_shared<FloquetArguments>();
  add_study_argument(command, &arguments->study);
  add_point_option(command, &arguments->at,
                   "Where to look: a value for each axis of the study, and for other parameters")
      ->delimiter(',');
  command
      ->add_option("--along", arguments->along,
                   "Follow the orbit and locate its bifurcations; starts where --at says, or else "
                   "at FROM")
      ->type_name("NAME=FROM:TO");
  command
      ->add_option("--period", arguments->period,
                   "The orbit's length in forcing periods (default: the smallest after which the "
                   "motion repeats, 64 at most)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 4096));
  command
      ->add_option("--steps", arguments->steps,
                   fmt::format("Integration steps per period (default: {} or the study's, if that "
                               "is more)",
                               kMinSteps))
      ->type_name(kNumberValue)
      ->check(whole_number(16, 65536));
  add_device_option(command, &arguments->device, false);
  add_set_option(command, &arguments->overrides);
  command->add_flag("--json", arguments->as_json, "For scripts, with every orbit on the way");
  command->footer(
      "Examples:\n"
      "  gearsweep floquet coarse-map --at omega=0.7,e0=0.5\n"
      "  gearsweep floquet coarse-map --at omega=0.7,e0=0.5 --along omega=0.6:0.8\n"
      "  gearsweep floquet coarse-map --at omega=0.55,e0=0.6 --period 1   an orbit inside chaos\n\n"
      "The engine settles the motion; Newton's method on the period map finds the orbit. Steps\n"
      "end where teeth meet or part. The digits shown are those that steps of twice the length\n"
      "agree on.");
  command->callback([arguments] {
    const FloquetFindings findings = compute(*arguments);
    answer("{}", arguments->as_json ? floquet_as_json(findings) : describe_floquet(findings));
  });
}

}  // namespace gearsweep
