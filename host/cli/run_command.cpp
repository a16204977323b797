// gearsweep run: from a study to finished maps, by one process or several.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/run_report.hpp"
#include "cli/run_request.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "scheduler/cluster_service.hpp"

namespace gearsweep {
namespace {

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
std::string agreement(const RunRequest& request) {
  return fmt::format("{}\n{}\n{}\n{}\n{}", request.study, request.output,
                     fmt::join(request.overrides, "\n"), fmt::join(request.zooms, "\n"),
                     source_hash());
}

// What a rank does that is not 0. It leaves signals, which a launcher passes on to all, to rank 0.
int serve(const RunRequest& request, Cluster* cluster) {
  try {
    serve_cluster(
        cluster, [&] { return share_of_devices(chosen_devices(request.devices), *cluster); }, warn);
    return kDone;
  } catch (const std::exception& error) {
    // Rank 0 may wait for its tiles.
    warn(fmt::format("rank {}: {}", cluster->rank(), error.what()));
    cluster->abort();
  }
  return kFailed;
}

// Runs with the other processes of an MPI launcher, if there are any; all but the first only
// compute tiles.
int run_together(RunRequest request, const Run& run) {
  // Shards know nothing of each other, whatever has started them.
  const std::unique_ptr<Cluster> cluster =
      request.shard.empty() ? Cluster::join() : std::unique_ptr<Cluster>();
  if (!cluster) {
    request.chosen_devices = chosen_devices(request.devices);
    return run(request);
  }
  const bool all_agree = cluster->all_say(agreement(request));
  if (cluster->rank() > 0) {
    request.signals->set(OnSignal::nothing);
    // Rank 0 says what is wrong, and fails: mpirun would end it as soon as another has failed.
    return all_agree ? serve(request, cluster.get()) : kDone;
  }
  if (!all_agree) {
    throw InputError(
        "the processes were started with different arguments or are of different versions; give "
        "all the same, or --shard K/N for processes that do not work together");
  }
  const Dismissal dismissal(cluster.get());
  request.cluster = cluster.get();
  request.chosen_devices = share_of_devices(chosen_devices(request.devices), *cluster);
  return run(request);
}

constexpr const char* kRunFooter =
    "Examples:\n"
    "  gearsweep run coarse-map -o map.nc --plot map.png\n"
    "  gearsweep run mine.toml --set parameters.mu=0 --set axes.omega.count=100\n"
    "  gearsweep run mine.toml --set model.backlash=dynamic --set integrate.record=20\n"
    "  gearsweep run map.nc -o again.nc           compute a result again, from itself\n"
    "  gearsweep run map.nc --zoom omega=1.5:1.9,e0=0.3:0.5:200 -o detail.nc\n"
    "  gearsweep run mine.toml --device all       on every device of the machine\n"
    "  gearsweep run mine.toml --dry-run          what it would take; computes next to "
    "nothing\n\n"
    "An interrupted run (Ctrl-C, SIGTERM, kill -9, power cut) keeps what is finished in\n"
    "OUT.nc.journal; the same command continues from there, 'gearsweep status OUT.nc' tells how\n"
    "far it is. Points that overflow or whose steps are too long for the stiffness get a status\n"
    "and NaN; the exit status is 1 only when all points do.";

}  // namespace

void add_run_command(CLI::App* app, const Run& run, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand("run", "Compute the maps of a study");
  const auto request = std::make_shared<RunRequest>();
  const auto lanes = std::make_shared<std::optional<std::size_t>>();
  const auto zooms = std::make_shared<std::vector<std::string>>();
  add_study_argument(command, &request->study, " to compute again");
  command
      ->add_option("-o,--output", request->output,
                   "The result file (default: the study's name with .nc, of a zoom with -zoom.nc)")
      ->type_name(kFileValue)
      ->check([](const std::string& path) { return path.empty() ? "must not be empty" : ""; });
  CLI::Option* plot =
      command->add_option("--plot", request->plot, "Also draw a picture: .png, .svg or .pdf")
          ->type_name(kFileValue);
  command
      ->add_option(
          "-q,--quantity", request->quantity,
          "The quantity to draw (default: on one axis the samples, if there are any, else the "
          "study's first)")
      ->type_name(kQuantityValue)
      ->needs(plot);
  add_device_option(command, &request->devices, true);
  command
      ->add_option("--shard", request->shard,
                   "K/N: compute only the K-th of N parts, for 'gearsweep merge' to put together")
      ->type_name(kShardValue)
      ->excludes(plot);
  command
      ->add_option("--lanes", *lanes,
                   "Points per work-item: 1, 2, 4, 8 or 16 (default: what suits the device)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 16));
  add_set_option(command, &request->overrides);
  command
      ->add_option("--zoom", *zooms,
                   "Another stretch of the study's axes, with as many values as before or with "
                   "COUNT; may be given several times")
      ->type_name(kZoomValue)
      ->allow_extra_args(false);
  command->add_flag("--restart", request->restart,
                    "Start afresh: discard what an interrupted run left in OUT.nc.journal");
  command->add_flag("--strict-device", request->strict_device,
                    "Continue an interrupted run only on the same devices and drivers");
  command->add_flag("--keep-journal", request->keep_journal,
                    "Keep OUT.nc.journal when the result is written");
  command->add_flag("--dry-run", request->dry_run,
                    "Only say what the run would take: time, memory, disk; writes nothing");
  command->add_flag("--quiet", request->quiet, "No progress and no summary");
  command->add_flag("--json", request->as_json, "Print the summary as JSON");
  command->footer(kRunFooter);
  command->callback([request, lanes, zooms, run, signals, status] {
    if (*lanes) request->overrides.push_back(fmt::format("integrate.lanes={}", **lanes));
    for (const std::string& several : *zooms) {
      for (const std::string& zoom : split(several, ',')) request->zooms.push_back(zoom);
    }
    request->signals = signals;
    *status = run_together(*request, run);
  });
}

}  // namespace gearsweep
