#include "cli/run_report.hpp"

#include "cli/commands.hpp"
#include "cli/detail/forecast_report.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/detail/summary.hpp"
#include "cli/standard_streams.hpp"
#include "scheduler/cluster.hpp"

namespace gearsweep {

void warn(const std::string& what) { tell("\ngearsweep: warning: {}\n", what); }

RunReport::RunReport(const RunRequest& request, const RunOutput& output)
    : request_(request), output_(output) {}

void RunReport::watch(SweepOptions* options) {
  options->warn = warn;
  options->stop = stop_on_signals(request_.signals, request_.quiet, options->scheduler);
  options->on_pilot = [this](std::size_t points) {
    if (!request_.quiet) tell("finding the step by a pilot run of {} points\n", points);
  };
  options->on_progress = [this](const SweepProgress& progress) {
    last_ = progress;
    if (!request_.quiet) bar_.show(progress);
  };
}

int RunReport::forecast(const std::optional<Forecast>& forecast) {
  if (!forecast) return tell_interrupted();
  answer("{}", request_.as_json ? forecast_as_json(*forecast)
                                : describe_forecast(*forecast, output_.path()));
  return kDone;
}

int RunReport::interrupted() {
  bar_.close();
  if (last_.share_kept == 0.0) {
    tell("gearsweep: interrupted before anything was finished\n");
  } else {
    tell(
        "gearsweep: interrupted; {:.0f} % of the work is done and kept in {}: the same command "
        "continues from there\n",
        100.0 * last_.share_kept, output_.journal());
  }
  return kInterrupted;
}

int RunReport::shard_done() {
  bar_.close();
  if (request_.as_json) {
    answer("{}", shard_as_json(request_.shard, output_.journal(), last_.points));
  }
  if (!request_.quiet) {
    tell("shard {} is done: {}; when all are: gearsweep merge {}.shard-*.journal -o {}\n",
         request_.shard, output_.journal(), output_.path(), output_.path());
  }
  return kDone;
}

void RunReport::written(const SweepResult& result) {
  bar_.close();
  // The file is whole, and what follows can be done again from it: a signal may end it at once.
  request_.signals->set(OnSignal::end);
  if (request_.as_json) answer("{}", run_as_json(result, output_.path()));
  if (!request_.quiet) {
    if (last_.points_resumed > 0) {
      tell("{:.0f} % of the work was in the journal of an interrupted run\n",
           100.0 * last_.share_resumed);
    }
    tell("{}", describe_run(result, output_.path()));
  }
}

void RunReport::plotted() {
  if (!request_.quiet) tell("{}\n", request_.plot);
}

int RunReport::finished(const SweepResult& result) {
  const Cluster* cluster = request_.cluster;
  if (cluster != nullptr && !request_.quiet) {
    tell("{} processes shared the work; they sent {} bytes for each point\n", cluster->size(),
         cluster->bytes_received() / result.study.trajectories());
  }
  return status_of(result);
}

}  // namespace gearsweep
