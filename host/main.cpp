// gearsweep, told in the order of its steps: from a study to the file of its maps. Arguments,
// reports and all other commands are in cli/.
#include <cstdio>
#include <cstdlib>

#include "cli/cli.hpp"
#include "cli/run_output.hpp"
#include "cli/run_report.hpp"
#include "cli/standard_streams.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

int run_study(const RunRequest& request) {
  // 1. Read the study: model, parameters, axes, what to observe.
  const Study study = requested_study(request);

  // 2. See that its maps can be written, before anything is computed.
  const RunOutput output(request, study);
  RunReport report(request, output);
  SweepOptions options = output.sweep_options();
  report.watch(&options);
  if (request.dry_run) return report.forecast(forecast_sweep(study, options));
  if (request.restart) output.discard_journal();
  if (options.shard.count > 0) {
    return run_shard(study, options) ? report.shard_done() : report.interrupted();
  }

  // 3. Compute its maps, step by step as sweep/sweep.cpp tells: choose the integration step, find
  // engines, plan tiles of points, open the journal, compute the tiles, assemble the maps.
  // 4. Write the file, after which the journal is removed.
  options.deliver = [&](const SweepResult& maps) { output.write(maps); };
  const std::optional<SweepResult> maps = run_sweep(study, options);
  if (!maps) return report.interrupted();
  report.written(*maps);

  // 5. Plot the picture of the file that --plot asks for.
  if (output.has_picture()) {
    output.plot();
    report.plotted();
  }
  return report.finished(*maps);
}

}  // namespace
}  // namespace gearsweep

int main(int argc, char** argv) {
  if (!gearsweep::open_standard_streams()) return EXIT_FAILURE;
  const int status = gearsweep::run_cli(argc, argv, gearsweep::run_study);
  if (status != 1) return status;
  // After a failed write the HDF5 library's exit handlers crash, so they are left out.
  std::fflush(nullptr);
  std::_Exit(status);
}
