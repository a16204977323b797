// gearsweep run: from a study to finished maps.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/arguments.hpp"
#include "cli/commands.hpp"
#include "cli/forecast_report.hpp"
#include "cli/progress_bar.hpp"
#include "cli/signal_watch.hpp"
#include "cli/study_source.hpp"
#include "cli/summary.hpp"
#include "distribute/cluster_worker.hpp"
#include "distribute/shards.hpp"
#include "io/plot.hpp"
#include "io/result_file.hpp"
#include "io/result_size.hpp"
#include "journal/journal.hpp"
#include "journal/notes.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

struct RunArguments {
  std::string study, output, plot, quantity, shard;
  std::string devices;
  std::optional<std::size_t> lanes;
  std::vector<std::string> overrides;
  bool restart = false;
  bool strict_device = false;
  bool keep_journal = false;
  bool quiet = false;
  bool as_json = false;
  bool dry_run = false;
};

// The command as it would be typed again.
std::string command_line(const RunArguments& arguments, const std::string& output) {
  std::string line = fmt::format("gearsweep run '{}' -o '{}'", arguments.study, output);
  if (!arguments.devices.empty()) line += fmt::format(" --device {}", arguments.devices);
  if (!arguments.shard.empty()) line += fmt::format(" --shard {}", arguments.shard);
  for (const std::string& assignment : arguments.overrides) {
    line += fmt::format(" --set '{}'", assignment);
  }
  return line;
}

std::string output_path(const RunArguments& arguments) {
  std::string path = arguments.output;
  if (path.empty()) path = std::filesystem::path(arguments.study).stem().string() + ".nc";
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

// Whether there is anything in the maps; says so when not.
bool any_point_is_ok(const SweepResult& result) {
  const bool any = std::any_of(result.status.begin(), result.status.end(),
                               [](std::uint8_t status) { return status == STATUS_ok; });
  if (!any) fmt::print(stderr, "gearsweep: every point failed; the maps are empty\n");
  return any;
}

void warn(const std::string& what) { fmt::print(stderr, "\ngearsweep: warning: {}\n", what); }

// A shard's journal is its result.
std::string journal_path(const RunArguments& arguments, const std::string& output) {
  if (arguments.shard.empty()) return output + ".journal";
  const Shard shard = parse_shard(arguments.shard);
  return fmt::format("{}.shard-{}-of-{}.journal", output, shard.number, shard.count);
}

// The exit status of an interrupted run.
int tell_interrupted(const SweepProgress& last, const std::string& journal) {
  if (last.share_kept == 0.0) {
    fmt::print(stderr, "gearsweep: interrupted before anything was finished\n");
  } else {
    fmt::print(stderr,
               "gearsweep: interrupted; {:.0f} % are finished and kept in {}: the same command "
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
  const ResultSize size = size_of_result(study);
  options.delivery = {size.file, size.memory};
  options.deliver = [=](const SweepResult& result) {
    discard_abandoned(output);  // the journal's lock keeps other runs away
    write_result(result, output, {command_line(arguments, output), version(), source_hash()});
  };
  return options;
}

// What `run --dry-run` does.
int tell_forecast(const Study& study, const SweepOptions& options, const std::string& output,
                  bool with_json) {
  const std::optional<Forecast> forecast = forecast_sweep(study, options);
  if (!forecast) return kInterrupted;
  fmt::print("{}", with_json ? forecast_as_json(*forecast) : describe_forecast(*forecast, output));
  return kDone;
}

// Rank 0 of a cluster tells the others when it is done, however it ends.
class Dismissal {
 public:
  explicit Dismissal(Cluster* cluster) : cluster_(cluster) {}
  ~Dismissal() {
    if (cluster_ != nullptr) dismiss_cluster(cluster_);
  }
  Dismissal(const Dismissal&) = delete;
  Dismissal& operator=(const Dismissal&) = delete;

 private:
  Cluster* cluster_;
};

// What must be the same for processes to work together.
std::string agreement(const RunArguments& arguments) {
  return fmt::format("{}\n{}\n{}\n{}", arguments.study, arguments.output,
                     fmt::join(arguments.overrides, "\n"), source_hash());
}

// What a rank does that is not 0. It leaves signals, which a launcher passes on to all, to rank 0.
int serve(const RunArguments& arguments, Cluster* cluster) {
  try {
    serve_cluster(
        cluster, [&] { return share_of_devices(chosen_devices(arguments.devices), *cluster); },
        warn);
    return kDone;
  } catch (const std::exception& error) {
    // Rank 0 may wait for its tiles.
    warn(fmt::format("rank {}: {}", cluster->rank(), error.what()));
    cluster->abort();
  }
  return kFailed;
}

int run_study(const RunArguments& given, const std::vector<DeviceChoice>& devices,
              Cluster* cluster) {
  RunArguments arguments = given;
  if (arguments.lanes) {
    arguments.overrides.push_back(fmt::format("integrate.lanes={}", *arguments.lanes));
  }
  const Study study = load_study(arguments.study, arguments.overrides);
  const std::string output = output_path(arguments);
  ensure_writable(output);
  if (!arguments.quantity.empty()) check_quantity(study, arguments.quantity);
  if (!arguments.plot.empty()) ensure_plottable(arguments.plot);
  SweepOptions options = sweep_options(arguments, study, output);
  options.devices = devices;
  options.cluster = cluster;
  const SignalWatch signals;
  options.stop = &signals.interrupted();
  if (arguments.dry_run) return tell_forecast(study, options, output, arguments.as_json);
  if (arguments.restart) Journal::discard(options.journal_path);

  ProgressBar bar;
  SweepProgress last;
  options.on_progress = [&](const SweepProgress& progress) {
    last = progress;
    if (!arguments.quiet) bar.show(progress);
  };
  if (!arguments.shard.empty()) {
    const bool is_done = run_shard(study, parse_shard(arguments.shard), options);
    bar.close();
    if (!is_done) return tell_interrupted(last, options.journal_path);
    if (!arguments.quiet) {
      fmt::print(stderr,
                 "shard {} is done: {}; when all are: gearsweep merge {}.shard-*.journal -o {}\n",
                 arguments.shard, options.journal_path, output, output);
    }
    return kDone;
  }
  const std::optional<SweepResult> result = run_sweep(study, options);
  bar.close();
  if (!result) return tell_interrupted(last, options.journal_path);
  if (arguments.as_json) fmt::print("{}", run_as_json(*result, output));
  if (!arguments.quiet) {
    if (last.points_resumed > 0) {
      fmt::print(stderr, "{:.0f} % were taken from the journal of an interrupted run\n",
                 100.0 * last.share_resumed);
    }
    fmt::print(stderr, "{}", describe_run(*result, output));
  }
  if (!arguments.plot.empty()) {
    PlotRequest request;
    request.paths = {output};
    request.quantity = arguments.quantity;
    request.output_path = arguments.plot;
    plot_files(request);
    if (!arguments.quiet) fmt::print(stderr, "{}\n", arguments.plot);
  }
  if (cluster != nullptr && !arguments.quiet) {
    fmt::print(stderr, "{} processes; {} bytes for each point came from the others\n",
               cluster->size(), cluster->bytes_received() / result->study.trajectories());
  }
  return any_point_is_ok(*result) ? kDone : kFailed;
}

int run(const RunArguments& arguments) {
  block_signals();
  // Shards know nothing of each other, whatever has started them.
  const std::unique_ptr<Cluster> cluster =
      arguments.shard.empty() ? Cluster::join() : std::unique_ptr<Cluster>();
  if (!cluster) return run_study(arguments, chosen_devices(arguments.devices), nullptr);
  const bool all_agree = cluster->all_say(agreement(arguments));
  if (cluster->rank() > 0) return all_agree ? serve(arguments, cluster.get()) : kWrongInput;
  if (!all_agree) {
    throw InputError(
        "the processes were started with different arguments or are of different versions; give "
        "all the same, or --shard K/N for processes that do not work together");
  }
  const Dismissal dismissal(cluster.get());
  return run_study(arguments, share_of_devices(chosen_devices(arguments.devices), *cluster),
                   cluster.get());
}

}  // namespace

void add_run_command(CLI::App* app, int* status) {
  CLI::App* command = app->add_subcommand("run", "Compute the maps of a study");
  const auto arguments = std::make_shared<RunArguments>();
  command
      ->add_option("study", arguments->study,
                   "A study file, a built-in study, or a result file to compute again")
      ->type_name(kStudyValue)
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "The result file (default: the study's name with .nc)")
      ->type_name(kFileValue)
      ->check([](const std::string& path) { return path.empty() ? "must not be empty" : ""; });
  CLI::Option* plot =
      command->add_option("--plot", arguments->plot, "Also draw a picture: .png, .svg or .pdf")
          ->type_name(kFileValue);
  command
      ->add_option(
          "-q,--quantity", arguments->quantity,
          "The quantity to draw (default: on one axis the samples, if there are any, else the "
          "study's first)")
      ->type_name(kQuantityValue)
      ->needs(plot);
  add_device_option(command, &arguments->devices, true);
  command
      ->add_option("--shard", arguments->shard,
                   "K/N: compute only the K-th of N parts, for 'gearsweep merge' to put together")
      ->type_name(kShardValue)
      ->excludes(plot);
  command
      ->add_option("--lanes", arguments->lanes,
                   "Points per work-item: 1, 2, 4, 8 or 16 (default: what suits the device)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 16));
  add_set_option(command, &arguments->overrides);
  command->add_flag("--restart", arguments->restart,
                    "Start afresh: discard what an interrupted run left in OUT.nc.journal");
  command->add_flag("--strict-device", arguments->strict_device,
                    "Continue an interrupted run only on the same devices and drivers");
  command->add_flag("--keep-journal", arguments->keep_journal,
                    "Keep OUT.nc.journal when the result is written");
  command->add_flag("--dry-run", arguments->dry_run,
                    "Only say what the run would take: time, memory, disk; writes nothing");
  command->add_flag("--quiet", arguments->quiet, "No progress and no summary");
  command->add_flag("--json", arguments->as_json, "Print the summary as JSON");
  command->footer(
      "Examples:\n"
      "  gearsweep run coarse-map -o map.nc --plot map.png\n"
      "  gearsweep run mine.toml --set parameters.mu=0 --set axes.omega.count=100\n"
      "  gearsweep run mine.toml --set model.backlash=dynamic --set integrate.record=20\n"
      "  gearsweep run map.nc -o again.nc           compute a result again, from itself\n"
      "  gearsweep run mine.toml --device all       on every device of the machine\n"
      "  gearsweep run mine.toml --dry-run          what it would take; computes next to "
      "nothing\n\n"
      "An interrupted run (Ctrl-C, SIGTERM, kill -9, power cut) keeps what is finished in\n"
      "OUT.nc.journal; the same command continues from there, 'gearsweep status OUT.nc' tells how\n"
      "far it is. Points that overflow or whose steps are too long for the stiffness get a status\n"
      "and NaN; the exit status is 1 only when all points do.");
  command->callback([arguments, status] { *status = run(*arguments); });
}

}  // namespace gearsweep
