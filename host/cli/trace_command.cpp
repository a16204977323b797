// gearsweep trace: the time history of points of a study or of a map.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/place.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "plan/plan.hpp"
#include "result/trace_file.hpp"
#include "sweep/trace_run.hpp"

namespace gearsweep {
namespace {

struct TraceArguments {
  std::string study, output;
  std::vector<std::string> at;  // one point each: "omega=0.7,b=1"
  std::vector<std::string> overrides;
  std::string device;
  std::optional<std::size_t> settle, record;
  std::size_t samples_per_period = 0;
  TableUnits units = TableUnits::model;
  bool quiet = false;
};

std::string command_line(const TraceArguments& arguments) {
  std::string line = "gearsweep trace " + shell_quoted(arguments.study);
  for (const std::string& point : arguments.at) line += " --at " + shell_quoted(point);
  if (arguments.settle) line += fmt::format(" --settle {}", *arguments.settle);
  if (arguments.record) line += fmt::format(" --record {}", *arguments.record);
  if (arguments.samples_per_period > 0) {
    line += fmt::format(" --samples-per-period {}", arguments.samples_per_period);
  }
  for (const std::string& text : arguments.overrides) line += " --set " + shell_quoted(text);
  return line + " -o " + shell_quoted(arguments.output);
}

// The nearest value of a swept axis; `value` must not lie beyond its ends.
std::size_t nearest_value(const Axis& axis, double value) {
  if (value < axis.values.front() || value > axis.values.back()) {
    throw InputError(fmt::format("--at: {} = {} is beyond the axis, {} .. {}", axis.name, value,
                                 axis.values.front(), axis.values.back()));
  }
  const auto nearest = std::min_element(
      axis.values.begin(), axis.values.end(),
      [&](double a, double b) { return std::abs(a - value) < std::abs(b - value); });
  return static_cast<std::size_t>(nearest - axis.values.begin());
}

// A point of a map is one of its grid; so is a point that goes on from its neighbours.
void snap(const Study& whole, bool is_map, std::vector<Placed>* place) {
  for (Placed& placed : *place) {
    for (std::size_t i = 0; i < whole.axes.size(); ++i) {
      const Axis& axis = whole.axes[i];
      if (axis.is_state != placed.is_state || axis.index != placed.index) continue;
      if (!is_map && !(whole.is_chained() && whole.initial.along == i)) continue;
      placed.value = axis.values[nearest_value(axis, placed.value)];
    }
  }
}

// The values of the axis that a chained study goes along, up to the point.
std::vector<double> chain_to(const Study& whole, double value) {
  const std::vector<double>& values = whole.axes[whole.initial.along].values;
  const auto own = std::find(values.begin(), values.end(), value);
  return info_of(whole.initial.policy).neighbour < 0 ? std::vector<double>(values.begin(), own + 1)
                                                     : std::vector<double>(own, values.end());
}

// The study of one point, as run_trace() wants it.
Study point_study(const Study& whole, const std::vector<Placed>& place) {
  Study study = whole;
  place_parameters(place, &study);
  const bool moves_start = std::any_of(place.begin(), place.end(), [&](const Placed& placed) {
    return placed.is_state &&
           std::none_of(whole.axes.begin(), whole.axes.end(), [&](const Axis& axis) {
             return axis.is_state && axis.index == placed.index;
           });
  });
  if (whole.is_chained()) {
    if (moves_start)
      throw InputError("--at: an initial state fits no study that sweeps along an axis");
    std::vector<double>& values = study.axes[study.initial.along].values;
    values = chain_to(whole, values.front());
  } else if (moves_start) {
    place_states(place, &study);
  }
  study.initial.ensemble = 1;
  return study;
}

std::string label_of(const Model& model, const std::vector<Placed>& place) {
  std::string label;
  for (const Placed& placed : place) {
    const std::string& name =
        placed.is_state ? model.states[placed.index].name : model.parameters[placed.index].name;
    label += fmt::format("{}{}={:.6g}", label.empty() ? "" : ", ", name, placed.value);
  }
  return label;
}

Study load(const TraceArguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  if (arguments.settle) {
    // Exactly so many, also where the point has settled on a periodic orbit before.
    overrides.push_back(fmt::format("integrate.settle={}", *arguments.settle));
    overrides.push_back("integrate.stop=never");
  }
  if (arguments.record) overrides.push_back(fmt::format("integrate.record={}", *arguments.record));
  Study study = load_study(arguments.study, overrides);
  if (study.integrate.tolerance > 0.0) {
    const std::optional<double> step =
        is_netcdf(arguments.study) ? read_pilot_step(arguments.study) : std::nullopt;
    if (!step && study.integrate.is_tolerance_asked) {
      throw InputError(fmt::format(
          "integrate.tolerance takes a map to find the step: trace a point of the finished map "
          "(gearsweep trace MAP.nc), or give the step, --set integrate.tolerance=0 --set "
          "integrate.max_step={}",
          study.model->max_step));
    }
    if (step) study.integrate.max_step = *step;
    study.integrate.tolerance = 0.0;  // the sweep to a chain's point takes this step, too
  }
  return study;
}

int run(const TraceArguments& arguments, SignalWatch* signals) {
  const Study whole = load(arguments);
  const bool is_map = is_netcdf(arguments.study);
  ensure_writable(arguments.output);
  ensure_trace_file(arguments.output, whole, arguments.units);
  SweepOptions options;
  options.devices = chosen_devices(arguments.device);
  options.stop = &signals->interrupted();
  signals->set(OnSignal::stop);
  std::vector<std::string> points = arguments.at;
  if (points.empty()) points.emplace_back();
  std::vector<Trace> traces;
  std::vector<std::string> labels, placed_names;
  for (const std::string& point : points) {
    std::vector<Placed> place;
    if (!point.empty()) place = read_place(*whole.model, split(point, ','));
    snap(whole, is_map, &place);
    const Study study = point_study(whole, place);
    const std::optional<Trace> trace = run_trace(study, arguments.samples_per_period, options);
    if (!trace) {
      tell("gearsweep: interrupted\n");
      return kInterrupted;
    }
    labels.push_back(label_of(*whole.model, place));
    traces.push_back(*trace);
    for (const Placed& placed : place) {
      if (placed.is_state) continue;
      const std::string& name = whole.model->parameters[placed.index].name;
      if (std::find(placed_names.begin(), placed_names.end(), name) == placed_names.end()) {
        placed_names.push_back(name);
      }
    }
    if (!arguments.quiet) {
      tell("{}: {} moments of {} periods after {}\n",
           labels.back().empty() ? "the study's point" : labels.back(), trace->tau.size(),
           study.integrate.record, trace->settled);
    }
  }
  write_traces(traces, labels, placed_names, whole, arguments.output,
               {command_line(arguments), version(), source_hash()}, arguments.units);
  if (!arguments.quiet) tell("{}\n", arguments.output);
  return kDone;
}

}  // namespace

void add_trace_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command =
      app->add_subcommand("trace", "The time history of points of a study or of a map");
  const auto arguments = std::make_shared<TraceArguments>();
  add_study_argument(command, &arguments->study, ": then --at means the nearest point of the map");
  add_point_option(command, &arguments->at,
                   "A point: a value for each axis, and for other parameters and initial states; "
                   "may be given several times");
  command->add_option("-o,--output", arguments->output, "The traces: .nc or .csv")
      ->type_name(kFileValue)
      ->required();
  command
      ->add_option(
          "--settle", arguments->settle,
          "Forcing periods before the trace, exactly so many (default: the study's, or fewer "
          "where the motion is periodic before; 0 shows the start)")
      ->type_name(kNumberValue)
      ->check(whole_number(0));
  command
      ->add_option("--record", arguments->record,
                   "Forcing periods of the trace (default: the study's)")
      ->type_name(kNumberValue)
      ->check(whole_number(1));
  command
      ->add_option("--samples-per-period", arguments->samples_per_period,
                   "Evenly spaced moments per forcing period, interpolated (default: both ends of "
                   "every integration step)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, std::size_t{1} << 20U));
  add_units_option(command, &arguments->units);
  add_device_option(command, &arguments->device, false);
  add_set_option(command, &arguments->overrides);
  command->add_flag("--quiet", arguments->quiet, "No summary");
  command->footer(
      "Examples:\n"
      "  gearsweep trace coarse-map --at omega=0.7,e0=0.5 --record 8 -o trace.nc\n"
      "  gearsweep trace map.nc --at omega=0.7,e0=0.5 --at omega=0.55,e0=0.6 -o two.nc\n"
      "  gearsweep trace map.nc --at omega=0.7,e0=0.5 --samples-per-period 256 -o trace.csv\n\n"
      "A point of a map passes through the map's own samples: same start, same steps.");
  command->callback([arguments, signals, status] { *status = run(*arguments, signals); });
}

}  // namespace gearsweep
