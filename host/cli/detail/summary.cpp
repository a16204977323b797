#include "cli/detail/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/detail/attractor_report.hpp"
#include "cli/detail/exponent_report.hpp"
#include "cli/detail/pilot_report.hpp"
#include "cli/detail/progress_bar.hpp"
#include "cli/detail/spectrum_report.hpp"
#include "cli/detail/tolerance_report.hpp"
#include "cli/standard_streams.hpp"
#include "plan/failed_start.hpp"
#include "result/json_text.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

struct Count {
  std::string name;
  std::size_t points;
};

std::vector<Count> count_statuses(const SweepResult& result) {
  std::vector<Count> counts;
  const auto add = [&](const char* name, int code) {
    const auto points = std::count(result.status.begin(), result.status.end(), code);
    if (points > 0) counts.push_back({name, static_cast<std::size_t>(points)});
  };
#define ADD_STATUS(name, code, meaning) add(#name, code);
  SWEEP_STATUSES(ADD_STATUS)
#undef ADD_STATUS
  return counts;
}

std::vector<Count> count_classes(const Quantity& quantity, const std::vector<double>& map) {
  std::vector<Count> counts;
  for (std::size_t i = 0; i < quantity.flags.size(); ++i) {
    const auto points = std::count(map.begin(), map.end(), static_cast<double>(i));
    counts.push_back({quantity.flags[i], static_cast<std::size_t>(points)});
  }
  return counts;
}

std::string describe_counts(const std::vector<Count>& counts) {
  std::string text;
  for (const Count& count : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count.name, count.points);
  }
  return text;
}

// The map of a quantity; nullptr when the study has it not.
const std::vector<double>* find_map(const SweepResult& result, const std::string& name) {
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    if (result.study.selection.quantities[i].name == name) return &result.values[i];
  }
  return nullptr;
}

// How many points had a negative backlash while recording, as far as the study tells.
std::size_t count_wedged(const SweepResult& result) {
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    if (result.study.selection.quantities[i].name != "contact_class") continue;
    for (const Count& count :
         count_classes(result.study.selection.quantities[i], result.values[i])) {
      if (count.name == "wedged") return count.points;
    }
  }
  const std::vector<double>* backlash = find_map(result, "backlash_min");
  if (backlash == nullptr) return 0;
  return static_cast<std::size_t>(
      std::ranges::count_if(*backlash, [](double min) { return min < 0.0; }));
}

// A set of points, and what to call it.
struct Group {
  std::string name;
  std::function<bool(std::size_t point)> has;
};

// The kinds of motion: by motion_class, else by period.
std::vector<Group> motion_groups(const SweepResult& result) {
  std::vector<Group> groups;
  const std::vector<double>* period = find_map(result, "period");
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    if (quantity.name != "motion_class") continue;
    const std::vector<double>& map = result.values[i];
    for (std::size_t flag = 0; flag < quantity.flags.size(); ++flag) {
      groups.push_back({quantity.flags[flag], [&map, flag](std::size_t point) {
                          return map[point] == static_cast<double>(flag);
                        }});
    }
    return groups;
  }
  if (period == nullptr) return {};
  return {{"period 0", [period](std::size_t point) { return (*period)[point] == 0.0; }},
          {"period > 0", [period](std::size_t point) { return (*period)[point] > 0.0; }}};
}

// What the largest Lyapunov exponent and the 0-1 test say, as far as the study has them. An
// exponent has a sign when it differs from zero by more than three of its errors. A cycle that
// nothing drives has an exponent 0, whose sign says nothing without the error.
std::vector<Group> verdict_groups(const SweepResult& result) {
  std::vector<Group> groups;
  const std::vector<double>* exponent = find_map(result, "lyapunov_max");
  const std::vector<double>* error = find_map(result, "lyapunov_max_error");
  const std::vector<double>* zero_one = find_map(result, "zero_one");
  if (exponent != nullptr && (error != nullptr || !result.study.model->is_clockless)) {
    const auto sign = [exponent, error](std::size_t point) {
      const double margin = error == nullptr ? 0.0 : 3.0 * (*error)[point];
      const double value = (*exponent)[point];
      return std::abs(value) > margin ? std::copysign(1.0, value) : 0.0;
    };
    groups.push_back({"exponent < 0", [sign](std::size_t point) { return sign(point) < 0.0; }});
    groups.push_back({"= 0", [sign](std::size_t point) { return sign(point) == 0.0; }});
    groups.push_back({"> 0", [sign](std::size_t point) { return sign(point) > 0.0; }});
  }
  if (zero_one != nullptr) {
    groups.push_back(
        {"0-1 test < 0.5", [zero_one](std::size_t point) { return (*zero_one)[point] < 0.5; }});
    groups.push_back(
        {">= 0.5", [zero_one](std::size_t point) { return (*zero_one)[point] >= 0.5; }});
  }
  return groups;
}

// How the kinds of motion agree with other verdicts: one row for each kind; empty when the study
// has only one of the two.
std::string describe_agreement(const SweepResult& result) {
  const std::vector<Group> rows = motion_groups(result);
  const std::vector<Group> columns = verdict_groups(result);
  if (rows.empty() || columns.empty()) return "";
  std::string text = fmt::format("{:16}", "points");
  for (const Group& column : columns) text += fmt::format("  {:>14}", column.name);
  text += '\n';
  for (const Group& row : rows) {
    text += fmt::format("  {:14}", row.name);
    for (const Group& column : columns) {
      std::size_t count = 0;
      for (std::size_t point = 0; point < result.status.size(); ++point) {
        const bool counts = has_values(result.status[point]);
        count += counts && row.has(point) && column.has(point) ? 1 : 0;
      }
      text += fmt::format("  {:>14}", count);
    }
    text += '\n';
  }
  return text;
}

// Without forcing the record of such a point may be a part of its motion, or of a way that is not
// over.
std::string describe_undecided(const SweepResult& result) {
  const Model& model = *result.study.model;
  const std::vector<double>* classes = find_map(result, "motion_class");
  if (classes == nullptr || !model.is_clockless || model.sections.empty()) return "";
  std::size_t count = 0;
  for (std::size_t point = 0; point < classes->size(); ++point) {
    const bool is_undecided = (*classes)[point] == double{MOTION_undecided};
    count += result.status[point] == STATUS_ok && is_undecided ? 1 : 0;
  }
  if (count == 0) return "";
  return fmt::format(
      "{} of {} points are undecided by their returns to '{}': their averages and extremes are of "
      "the stretch that was recorded, and need not be those of the motion; a longer "
      "integrate.record, a shorter integrate.max_step, or a section where another state is largest "
      "([sections.NAME] maximum_of = \"STATE\", observe.section = \"NAME\") may tell\n",
      count, classes->size(), model.sections.front().name);
}

std::string describe_unstable_starts(const SweepResult& result) {
  const auto count = std::ranges::count(result.status, std::uint8_t{STATUS_unstable_start});
  if (count == 0) return "";
  return fmt::format(
      "{} of {} points start at an unstable equilibrium: they show it, or what rounding makes of "
      "it; "
      "[initial] state = {{...}} starts them elsewhere\n",
      count, result.status.size());
}

// Where a surface may be met too often, which shorter steps would tell.
std::string describe_diverged(const SweepResult& result) {
  const auto count = std::ranges::count(result.status, std::uint8_t{STATUS_diverged});
  if (count == 0 || result.study.model->surfaces.empty()) return "";
  return fmt::format(
      "{} of {} points diverged: a state had no bound, or surfaces were met hundreds of times "
      "within a step; shorter steps (integrate.max_step) tell which\n",
      count, result.status.size());
}

std::string describe_long_steps(const SweepResult& result) {
  const auto count = std::ranges::count(result.status, std::uint8_t{STATUS_step_too_long});
  if (count == 0) return "";
  return fmt::format(
      "{} of {} points end where their steps are too long to follow the motion (integrate.max_step "
      "= {:.3g} in effect): either the motion grows without bounds, or shorter steps are needed\n",
      count, result.status.size(), result.study.integrate.max_step);
}

// Counts, for each quantity of a signal, the points that are ok at which it is infinite or no
// number. The motion is all right there, but what the signal is made of is not, such as 1/x at x =
// 0.
std::vector<Count> count_not_finite(const SweepResult& result) {
  std::vector<Count> counts;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    const bool is_of_signal = result.study.model->find_signal(quantity.channel) >= 0;
    if (!is_of_signal || quantity.divided_by || quantity.of_draws) continue;
    Count count = {quantity.name, 0};
    for (std::size_t point = 0; point < result.status.size(); ++point) {
      const auto first =
          result.values[i].begin() + static_cast<std::ptrdiff_t>(point * quantity.width);
      const bool is_finite = std::all_of(first, first + static_cast<std::ptrdiff_t>(quantity.width),
                                         [](double value) { return std::isfinite(value); });
      count.points += has_values(result.status[point]) && !is_finite ? 1 : 0;
    }
    if (count.points > 0) counts.push_back(count);
  }
  return counts;
}

nlohmann::json counts_as_json(const std::vector<Count>& counts) {
  nlohmann::json json = nlohmann::json::object();
  for (const Count& count : counts) json[count.name] = count.points;
  return json;
}

}  // namespace

std::string describe_integrated(const std::vector<std::string>& integrated, std::size_t states) {
  if (integrated.size() == states) return "";
  return fmt::format("{} of {} states are integrated ({}); the maps do not need the others\n",
                     integrated.size(), states, fmt::join(integrated, ", "));
}

std::string describe_run(const SweepResult& result, const std::string& path) {
  std::string text =
      fmt::format("{} points: {}\n", result.status.size(), describe_counts(count_statuses(result)));
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    if (quantity.flags.empty()) continue;
    text += fmt::format("{}: {}\n", quantity.name,
                        describe_counts(count_classes(quantity, result.values[i])));
  }
  for (const Count& count : count_not_finite(result)) {
    text += fmt::format("{} is infinite or no number at {} points that are ok\n", count.name,
                        count.points);
  }
  if (const std::size_t wedged = count_wedged(result); wedged > 0) {
    text += fmt::format("{} of {} points are wedged: a negative backlash, both flanks at once\n",
                        wedged, result.status.size());
  }
  if (result.stopped > 0) {
    text += fmt::format("{} of {} trajectories stopped early, on a periodic orbit\n",
                        result.stopped, result.study.trajectories());
  }
  text += describe_diverged(result);
  text += describe_long_steps(result);
  text += describe_undecided(result);
  text += describe_unstable_starts(result);
  if (!result.study.accuracy.empty()) text += result.study.accuracy + "\n";
  text += describe_integrated(result.integrated, result.study.model->states.size());
  if (const std::string steps = describe_steps(result.study, result.pilot); !steps.empty()) {
    text += "steps of " + steps;
  }
  text += describe_clock(result.study);
  text += describe_attractors(result);
  text += describe_tolerances(result);
  text += describe_spectrum(result);
  text += describe_agreement(result);
  text += describe_exponent_checks(result);
  text += fmt::format("{} on {}", format_duration(result.seconds), result.engine.device);
  if (result.steps > 0.0) {
    text += fmt::format(", {:.3g} steps, {:.1f} M steps/s", result.steps,
                        result.steps / result.seconds / 1e6);
  }
  if (result.kernel_seconds > 0.0) {
    text += fmt::format(", {:.0f} % in kernels", 100.0 * result.kernel_seconds / result.seconds);
  }
  return text + fmt::format("\n{}\n", path);
}

std::string run_as_json(const SweepResult& result, const std::string& path) {
  nlohmann::json json;
  json["file"] = path;
  json["points"] = result.status.size();
  json["status"] = counts_as_json(count_statuses(result));
  json["classes"] = nlohmann::json::object();
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    if (quantity.flags.empty()) continue;
    json["classes"][quantity.name] = counts_as_json(count_classes(quantity, result.values[i]));
  }
  json["not_finite"] = counts_as_json(count_not_finite(result));
  if (result.study.selection.census) json["attractors"] = attractors_as_json(result);
  if (const nlohmann::json checks = exponent_checks_as_json(result); !checks.is_null()) {
    json["exponent_checks"] = checks;
  }
  if (const nlohmann::json spectrum = spectrum_as_json(result); !spectrum.is_null()) {
    json["load_spectrum"] = spectrum;
  }
  json["seconds"] = result.seconds;
  json["kernel_seconds"] = result.kernel_seconds;
  json["steps"] = result.steps;
  json["stopped"] = result.stopped;
  json["integrated_states"] = result.integrated;
  json["max_step"] = result.study.integrate.max_step;
  json["orbit_steps"] = result.study.integrate.orbit_steps;
  if (!result.study.accuracy.empty()) json["accuracy"] = result.study.accuracy;
  if (result.pilot) json["pilot"] = pilot_as_json(*result.pilot);
  json["device"] = result.engine.device;
  return json_text(json);
}

std::string shard_as_json(const std::string& shard, const std::string& journal,
                          std::size_t points) {
  const nlohmann::json json = {{"shard", shard}, {"journal", journal}, {"points", points}};
  return json_text(json);
}

int status_of(const SweepResult& result) {
  if (std::ranges::any_of(result.status, has_values)) return kDone;
  tell("gearsweep: every point failed; the maps are empty\n");
  const std::string failure = failure_at_start(Plan(result.study, result.study.points()), 0);
  if (!failure.empty()) tell("gearsweep: the first one, {}\n", failure);
  return kFailed;
}

}  // namespace gearsweep
