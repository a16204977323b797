// gearsweep trace: the time history of points of a study or of a map.
#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/place_text.hpp"
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
  std::vector<std::string> overrides = arguments.overrides;
  for (std::string& own : trace_overrides(arguments.settle, arguments.record)) {
    overrides.push_back(std::move(own));
  }
  Study study = load_study(arguments.study, overrides);
  settle_step(is_netcdf(arguments.study) ? read_pilot_step(arguments.study) : std::nullopt, &study);
  return study;
}

// A signal ends it at any time: there is nothing to keep.
void run(const TraceArguments& arguments) {
  const Study whole = load(arguments);
  const bool is_map = is_netcdf(arguments.study);
  ensure_writable(arguments.output);
  ensure_trace_file(arguments.output, whole, arguments.units);
  SweepOptions options;
  options.devices = chosen_devices(arguments.device);
  std::vector<std::string> points = arguments.at;
  if (points.empty()) points.emplace_back();
  PointTraces found;
  for (const std::string& point : points) {
    const std::vector<std::string> at =
        point.empty() ? std::vector<std::string>{} : split(point, ',');
    const Place place = read_place(whole, at);
    add_point_trace(whole, is_map, place, arguments.samples_per_period, options, &found);
    if (!arguments.quiet) {
      const std::string& label = found.labels.back();
      tell("{}: {} moments of {} periods after {}\n", label.empty() ? "the study's point" : label,
           found.traces.back().tau.size(), whole.integrate.record, found.traces.back().settled);
    }
  }
  write_traces(found.traces, found.labels, found.placed, whole, arguments.output,
               {command_line(arguments), version(), source_hash()}, arguments.units);
  if (!arguments.quiet) tell("{}\n", arguments.output);
}

}  // namespace

void add_trace_command(CLI::App* app) {
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
  command->callback([arguments] { run(*arguments); });
}

}  // namespace gearsweep
