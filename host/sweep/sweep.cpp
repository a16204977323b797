#include "sweep/sweep.hpp"

#include "sweep/pilot.hpp"
#include "sweep/run_context.hpp"

namespace gearsweep {
namespace {

class Sweep {
 public:
  // The journal is held from now on: others see that the run goes on.
  Sweep(const Study& study, const SweepOptions& options)
      : study_(study), options_(options), journal_(options.journal_path) {}

  // False when stopped.
  bool compute() {
    // 1. Choose the integration step: as given, or as a pilot run finds for a tolerance.
    stepped_ = choose_step(study_, options_);
    if (!stepped_) return false;
    run_.emplace(*stepped_, options_);

    // 2. Find the engines: one to three on each device, with the kernels built for this study.
    run_->find_engines();

    // 3. Plan: points, and tiles of them that keep the engines busy and fit the machine.
    run_->plan_tiles();

    // 4. Open the journal, which may have tiles of an interrupted run.
    run_->open_journal(&journal_);

    // 5. Compute the tiles that it does not have: workers, a thread for each engine, call
    // run_tile() of tile/tile_run.hpp. A finished tile goes into the journal and the maps.
    return run_->compute_tiles();
  }

  SweepResult deliver() {
    // 6. Take the maps, whose attractors are told apart now that all points are there.
    SweepResult maps = run_->assemble_maps();

    // 7. Put them in a safe place, after which nothing needs the journal any more.
    if (options_.deliver) options_.deliver(maps);
    run_->close_journal();
    return maps;
  }

 private:
  const Study& study_;
  const SweepOptions& options_;
  JournalHold journal_;
  std::optional<SteppedStudy> stepped_;
  std::optional<RunContext> run_;
};

}  // namespace

std::optional<SweepResult> run_sweep(const Study& study, const SweepOptions& options) {
  Sweep sweep(study, options);
  if (!sweep.compute()) return std::nullopt;
  return sweep.deliver();
}

bool run_shard(const Study& study, const SweepOptions& options) {
  return Sweep(study, options).compute();
}

}  // namespace gearsweep
