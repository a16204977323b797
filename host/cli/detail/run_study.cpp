#include "cli/detail/run_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/forecast_report.hpp"
#include "cli/detail/progress_bar.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/detail/summary.hpp"
#include "cli/standard_streams.hpp"
#include "journal/journal.hpp"
#include "journal/notes.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "plot/plot.hpp"
#include "result/damage.hpp"
#include "result/result_file.hpp"
#include "result/result_size.hpp"
#include "result/trace_file.hpp"
#include "sweep/shard_run.hpp"
#include "workers/cluster.hpp"

namespace gearsweep {
namespace {

// The command as it would be typed again, to go on where it was interrupted.
std::string command_line(const RunArguments& arguments, const std::string& output) {
  std::string line =
      fmt::format("gearsweep run {} -o {}", shell_quoted(arguments.study), shell_quoted(output));
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) line += fmt::format(" {} {}", option, shell_quoted(value));
  };
  const auto add_flag = [&](const char* option, bool is_given) {
    if (is_given) line += fmt::format(" {}", option);
  };
  if (!arguments.devices.empty()) line += fmt::format(" --device {}", arguments.devices);
  if (!arguments.shard.empty()) line += fmt::format(" --shard {}", arguments.shard);
  for (const std::string& assignment : arguments.overrides) add("--set", assignment);
  for (const std::string& zoom : arguments.zooms) add("--zoom", zoom);
  add("--plot", arguments.plot);
  add("-q", arguments.quantity);
  add_flag("--strict-device", arguments.strict_device);
  add_flag("--keep-journal", arguments.keep_journal);
  add_flag("--quiet", arguments.quiet);
  add_flag("--json", arguments.as_json);
  return line;
}

// What stands in the way of a result of this study; empty: nothing that would be missed.
std::string what_is_lost(const std::string& path, const Study& study) {
  if (!is_netcdf(path)) return "";
  try {
    ensure_undamaged(path);
    if (is_trace_file(path)) return "traces";
    if (read_study(read_study_text(path), path).toml == study.toml) return "";
    const std::string title = ResultFile(path).title();
    return "the result of another study" + (title.empty() ? "" : fmt::format(", '{}'", title));
  } catch (const std::exception&) {
    return "what is no whole result of 'gearsweep run'";
  }
}

// Without -o the name of the study, of a zoom another one.
std::string output_path(const RunArguments& arguments) {
  std::string path = arguments.output;
  if (path.empty()) {
    path = std::filesystem::path(arguments.study).stem().string();
    path += arguments.zooms.empty() ? ".nc" : "-zoom.nc";
  }
  std::error_code error;
  if (std::filesystem::equivalent(path, arguments.study, error)) {
    throw InputError(
        fmt::format("{}: the result would replace its own study; give another output: "
                    "-o OUT.nc",
                    arguments.study));
  }
  if (std::filesystem::is_regular_file(path, error) && !is_netcdf(path)) {
    throw InputError(
        fmt::format("{}: exists and is no result file; it would be lost: give another "
                    "output, -o OUT.nc",
                    path));
  }
  return path;
}

// An earlier zoom must not be lost to a name that nobody gave; what was named is told of.
void guard_replaced(const RunArguments& arguments, const Study& study, const std::string& output) {
  if (!arguments.shard.empty() || arguments.dry_run) return;
  const std::string lost = what_is_lost(output, study);
  if (lost.empty()) return;
  if (arguments.output.empty() && !arguments.zooms.empty()) {
    throw InputError(fmt::format("{}: holds {}; give another output, -o OUT.nc", output, lost));
  }
  tell("gearsweep: warning: {} holds {}; this run will replace it\n", output, lost);
}

// A quantity to draw must be one that the study computes.
void check_quantity(const Study& study, const std::string& quantity) {
  const std::string name = quantity.substr(0, quantity.find(':'));
  std::vector<std::string> known = {"status"};
  for (const Quantity& candidate : study.selection.quantities) known.push_back(candidate.name);
  if (!study.selection.poincare.empty()) known.push_back("poincare");
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    throw InputError(
        fmt::format("-q {}: the study does not compute it{}", quantity, suggest_name(name, known)));
  }
}

// A shard's journal is its result.
std::string journal_path(const RunArguments& arguments, const std::string& output) {
  if (arguments.shard.empty()) return output + ".journal";
  const Shard shard = parse_shard(arguments.shard);
  return fmt::format("{}.shard-{}-of-{}.journal", output, shard.number, shard.count);
}

// The exit status of an interrupted run.
int tell_interrupted(const SweepProgress& last, const std::string& journal) {
  if (last.share_kept == 0.0) {
    tell("gearsweep: interrupted before anything was finished\n");
  } else {
    tell(
        "gearsweep: interrupted; {:.0f} % of the work is done and kept in {}: the same command "
        "continues from there\n",
        100.0 * last.share_kept, journal);
  }
  return kInterrupted;
}

SweepOptions sweep_options(const RunArguments& arguments, const Study& study,
                           const std::string& output) {
  SweepOptions options;
  options.journal_path = journal_path(arguments, output);
  options.strict_device = arguments.strict_device;
  options.keep_journal = arguments.keep_journal;
  options.notes = {{notes::kCommand, command_line(arguments, output)}};
  options.on_trouble = warn;
  const Provenance provenance = {command_line(arguments, output), version(), source_hash()};
  const ResultSize size = size_of_result(study, provenance);
  options.delivery = {size.file, size.memory};
  options.deliver = [=](const SweepResult& result) {
    discard_abandoned(output);  // the journal's lock keeps other runs away
    write_result(result, output, provenance);
  };
  return options;
}

// What `run --dry-run` does.
int tell_forecast(const Study& study, const SweepOptions& options, const std::string& output,
                  bool with_json) {
  const std::optional<Forecast> forecast = forecast_sweep(study, options);
  if (!forecast) {
    tell("gearsweep: interrupted\n");
    return kInterrupted;
  }
  answer("{}", with_json ? forecast_as_json(*forecast) : describe_forecast(*forecast, output));
  return kDone;
}

// Shows how far the run is, and keeps the last of it in `last`; both outlive the run.
void watch_progress(const RunArguments& arguments, ProgressBar* bar, SweepProgress* last,
                    SweepOptions* options) {
  options->on_progress = [bar, last, is_quiet = arguments.quiet](const SweepProgress& progress) {
    *last = progress;
    if (!is_quiet) bar->show(progress);
  };
}

int run_one_shard(const RunArguments& arguments, const Study& study, const std::string& output,
                  SweepOptions options) {
  ProgressBar bar;
  SweepProgress last;
  watch_progress(arguments, &bar, &last, &options);
  const bool is_done = run_shard(study, parse_shard(arguments.shard), options);
  bar.close();
  if (!is_done) return tell_interrupted(last, options.journal_path);
  if (arguments.as_json) {
    answer("{}", shard_as_json(arguments.shard, options.journal_path, last.points));
  }
  if (!arguments.quiet) {
    tell("shard {} is done: {}; when all are: gearsweep merge {}.shard-*.journal -o {}\n",
         arguments.shard, options.journal_path, output, output);
  }
  return kDone;
}

void draw(const RunArguments& arguments, const std::string& output) {
  PlotRequest request;
  request.paths = {output};
  request.quantity = arguments.quantity;
  request.output_path = arguments.plot;
  plot_files(request);
  if (!arguments.quiet) tell("{}\n", arguments.plot);
}

int run_whole(const RunArguments& arguments, const Study& study, const std::string& output,
              SweepOptions options, SignalWatch* signals) {
  ProgressBar bar;
  SweepProgress last;
  watch_progress(arguments, &bar, &last, &options);
  const std::optional<SweepResult> result = run_sweep(study, options);
  bar.close();
  signals->set(OnSignal::end);
  if (!result) return tell_interrupted(last, options.journal_path);
  if (arguments.as_json) answer("{}", run_as_json(*result, output));
  if (!arguments.quiet) {
    if (last.points_resumed > 0) {
      tell("{:.0f} % of the work was in the journal of an interrupted run\n",
           100.0 * last.share_resumed);
    }
    tell("{}", describe_run(*result, output));
  }
  if (!arguments.plot.empty()) draw(arguments, output);
  const Cluster* cluster = options.cluster;
  if (cluster != nullptr && !arguments.quiet) {
    tell("{} processes; {} bytes for each point came from the others\n", cluster->size(),
         cluster->bytes_received() / result->study.trajectories());
  }
  return status_of(*result);
}

}  // namespace

void warn(const std::string& what) { tell("\ngearsweep: warning: {}\n", what); }

int run_study(const RunArguments& given, const std::vector<DeviceChoice>& devices, Cluster* cluster,
              SignalWatch* signals) {
  RunArguments arguments = given;
  if (arguments.lanes) {
    arguments.overrides.push_back(fmt::format("integrate.lanes={}", *arguments.lanes));
  }
  const Study study = load_study(arguments.study, arguments.overrides, arguments.zooms);
  const std::string output = output_path(arguments);
  ensure_writable(output);
  if (!arguments.quantity.empty()) check_quantity(study, arguments.quantity);
  if (!arguments.plot.empty()) ensure_plottable(arguments.plot);
  guard_replaced(arguments, study, output);
  SweepOptions options = sweep_options(arguments, study, output);
  options.devices = devices;
  options.cluster = cluster;
  options.stop = &signals->interrupted();
  signals->set(OnSignal::stop);
  if (arguments.dry_run) return tell_forecast(study, options, output, arguments.as_json);
  if (arguments.restart) Journal::discard(options.journal_path);
  return arguments.shard.empty() ? run_whole(arguments, study, output, std::move(options), signals)
                                 : run_one_shard(arguments, study, output, std::move(options));
}

}  // namespace gearsweep
