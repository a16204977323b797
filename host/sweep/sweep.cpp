#include "sweep/sweep.hpp"

#include "sweep/pilot.hpp"
#include "sweep/setup.hpp"
#include "sweep/tile_loop.hpp"

namespace gearsweep {
namespace {

// The sweep, once its steps are known.
std::optional<SweepResult> run_with_steps(const Study& study,
                                          const std::optional<PilotFindings>& pilot,
                                          const SweepOptions& options) {
  const Shard all;
  Setup setup(study, all, options);
  Assembly assembly(study);
  TileLoop loop(*setup.plan, all, options, setup.crew.get(), setup.journal_or_null(), &assembly);
  if (!loop.run()) {
    if (setup.journal && setup.journal->finished_tiles() == 0) setup.journal->remove();
    return std::nullopt;
  }
  SweepResult result = assembly.take();
  result.engine.driver = setup.info.driver;
  result.engine.macros = setup.info.macros;
  result.pilot = pilot;
  if (options.deliver) options.deliver(result);
  if (setup.journal && !options.keep_journal) setup.journal->remove();
  return result;
}

}  // namespace

std::optional<SweepResult> run_sweep(const Study& study, const SweepOptions& options) {
  if (study.integrate.tolerance > 0.0) {
    const std::optional<PilotRun> pilot = find_step(study, options);
    if (!pilot) return std::nullopt;
    return run_with_steps(pilot->study, pilot->findings, options);
  }
  return run_with_steps(study, std::nullopt, options);
}

}  // namespace gearsweep
