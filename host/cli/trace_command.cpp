// gearsweep trace: the time history of points of a study or of a map.
#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/place_text.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "point/point_trace.hpp"
#include "result/trace_file.hpp"

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

Study load(const TraceArguments& arguments) {
  Study study = with_windows(load_study(arguments.study, arguments.overrides),
                             {arguments.settle, arguments.record});
  settle_step(is_netcdf(arguments.study) ? read_pilot_step(arguments.study) : std::nullopt, &study);
  return study;
}

// What a trace has, and how far its spectrum reaches.
std::string describe(const PointTraces& found, const TraceArguments& arguments,
                     std::size_t record) {
  const Trace& trace = found.traces.back();
  const std::string& label = found.labels.back();
  const std::string each =
      trace.mesh_periods == 1.0
          ? ""
          : fmt::format(" of the forcing, {:g} mesh periods each,", trace.mesh_periods);
  std::string text = fmt::format("{}: {} moments of {} periods{} after {}\n",
                                 label.empty() ? "the study's point" : label, trace.tau.size(),
                                 record, each, trace.settled);
  if (arguments.samples_per_period > 0) {
    text +=
        fmt::format("its spectrum goes up to order {:g}; what is above comes down to lower ones\n",
                    0.5 * static_cast<double>(arguments.samples_per_period));
  }
  return text;
}

// A signal ends it at any time: there is nothing to keep.
void run(const TraceArguments& arguments) {
  const Study whole = load(arguments);
  const bool is_map = is_netcdf(arguments.study);
  refuse_own_output(arguments.study, arguments.output);
  ensure_writable(arguments.output);
  ensure_trace_file(arguments.output, whole, arguments.units);
  SweepOptions options;
  options.devices = chosen_devices(arguments.device);
  tell_long_compiles(options.scheduler.get(), arguments.quiet);
  std::vector<std::string> points = arguments.at;
  if (points.empty()) points.emplace_back();
  PointTraces found;
  for (const std::string& point : points) {
    const std::vector<std::string> at =
        point.empty() ? std::vector<std::string>{} : split(point, ',');
    const Place place = read_place(whole, at);
    const std::string nearest = is_map && !whole.is_chained() ? nearest_point(whole, place) : "";
    if (!nearest.empty() && !arguments.quiet) {
      tell("{} lies between the points of the map; the nearest is {}\n",
           label_of(*whole.model, place), nearest);
    }
    add_point_trace(whole, place, {arguments.settle, arguments.record},
                    arguments.samples_per_period, options, &found);
    if (!arguments.quiet) tell("{}", describe(found, arguments, whole.integrate.record));
  }
  for (const std::string& notice : found.notices) tell("gearsweep: warning: {}\n", notice);
  write_traces(found.traces, found.labels, found.placed, whole, arguments.output,
               {command_line(arguments), version(), source_hash()}, arguments.units);
  if (!arguments.quiet) tell("{}\n", arguments.output);
}

}  // namespace

void add_trace_command(CLI::App* app) {
  CLI::App* command =
      app->add_subcommand("trace", "The time history of points of a study or of a map");
  const auto arguments = std::make_shared<TraceArguments>();
  add_study_argument(command, &arguments->study, ", whose step is taken");
  add_point_option(command, &arguments->at,
                   "A point: a value for each axis, and for other parameters and initial states; "
                   "taken as it is, also between the points of a map; may be given several times");
  command->add_option("-o,--output", arguments->output, "The traces: .nc or .csv")
      ->type_name(kFileValue)
      ->required();
  command
      ->add_option(
          "--settle", arguments->settle,
          "Mesh periods before the trace, exactly so many, or up to a whole period of the forcing "
          "(default: the study's, or fewer where the motion is periodic before; 0 shows the start)")
      ->type_name(kNumberValue)
      ->check(whole_number(0));
  command
      ->add_option("--record", arguments->record,
                   "Mesh periods of the trace, up to a whole period of the forcing, which has many "
                   "where a gear has a fault (default: the study's)")
      ->type_name(kNumberValue)
      ->check(whole_number(1));
  command
      ->add_option(
          "--samples-per-period", arguments->samples_per_period,
          "Evenly spaced moments in each mesh period, interpolated (default: both ends of "
          "every integration step). A spectrum goes up to half as many orders of the mesh; "
          "what is above comes down to lower ones")
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
      "At a point of a map the trace passes through the map's own samples: same start, same "
      "steps.");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace gearsweep
