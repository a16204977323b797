// gearsweep, told in the order of its steps: from a study to the file of its maps. Arguments,
// reports and all other commands are in cli/.
#include <cstdio>
#include <cstdlib>

#include "cli/cli.hpp"
#include "cli/run_output.hpp"
#include "cli/run_report.hpp"
#include "cli/standard_streams.hpp"
#include "sweep/run_context.hpp"

namespace gearsweep {
namespace {

int run_study(const RunRequest& request) {
  // 1. Read the study: model, parameters, axes, what to observe.
  const Study study = requested_study(request);

  // 2. See that its maps can be written, before anything is computed, and hold the journal: others
  // see that the run goes on.
  const RunOutput output(request, study);
  RunReport report(request, output);
  SweepOptions options = output.sweep_options();
  report.watch(&options);
  if (request.dry_run) return report.forecast(forecast_sweep(study, options));
  if (request.restart) output.discard_journal();
  JournalHold journal(options.journal_path);

  // 3. Choose the integration step: as given, or as a pilot run finds for a tolerance.
  const std::optional<SteppedStudy> stepped = choose_step(study, options);
  if (!stepped) return report.interrupted();
  RunContext run(*stepped, options);

  // 4. Find the engines: one to three on each device, with the kernels built for this study.
  run.find_engines();

  // 5. Plan: points, and tiles of them that keep the engines busy and fit the machine.
  run.plan_tiles();

  // 6. Open the journal, which may have tiles of an interrupted run.
  run.open_journal(&journal);

  // 7. Compute the tiles that it does not have: workers, a thread for each engine, call run_tile()
  // of tile/tile_run.hpp. A finished tile goes into the journal and the maps.
  if (!run.compute_tiles()) return report.interrupted();
  if (options.shard.count > 0) return report.shard_done();

  // 8. Take the maps, whose attractors are told apart now that all points are there.
  const SweepResult maps = run.assemble_maps();

  // 9. Write the file, after which nothing needs the journal any more.
  output.write(maps);
  run.close_journal();
  report.written(maps);

  // 10. Draw the picture of the file that --plot asks for.
  if (output.has_picture()) {
    output.draw();
    report.drawn();
  }
  return report.finished(maps);
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
