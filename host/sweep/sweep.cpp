#include "sweep/sweep.hpp"

#include "sweep/pilot.hpp"
#include "sweep/run_context.hpp"

namespace gearsweep {

std::optional<SweepResult> run_sweep(const Study& study, const SweepOptions& options) {
  JournalHold journal(options.journal_path);
  const std::optional<SteppedStudy> stepped = choose_step(study, options);
  if (!stepped) return std::nullopt;
  RunContext run(*stepped, options);
  run.find_engines();
  run.plan_tiles();
  run.open_journal(&journal);
  if (!run.compute_tiles()) return std::nullopt;
  SweepResult result = run.assemble_maps();
  if (options.deliver) options.deliver(result);
  run.close_journal();
  return result;
}

}  // namespace gearsweep
