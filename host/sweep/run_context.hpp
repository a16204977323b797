// Engines, plan, journal and workers of one run, in the order in which it needs them.
#pragma once

#include <memory>
#include <optional>

#include "journal/journal.hpp"
#include "journal/notes.hpp"
#include "scheduler/worker_pool.hpp"
#include "sweep/assembly.hpp"
#include "sweep/pilot.hpp"
#include "sweep/sweep_options.hpp"
#include "sweep/tile_plan.hpp"

namespace gearsweep {

// What two runs must have in common for one to continue the other's journal, and for shards to be
// merged.
Identity identity_of(const Study& study, const Shard& shard);

// Why a study cannot run in shards, as the beginning of a message; empty where it can.
std::string why_no_shards(const Study& study);

// Its functions are called once each, in this order. They throw InputError when the study does not
// fit the machine or the journal, RunError when no device works or a file cannot be written.
class RunContext {
 public:
  // Both outlive it. Throws InputError for shards of a study that goes along chains, whose tiles
  // need each other.
  RunContext(const SteppedStudy& stepped, const SweepOptions& options);

  // Those of the options' devices, with their kernels built. Writes nothing.
  void find_engines();
  // Tiles that keep the engines busy and fit the machine. Writes nothing.
  void plan_tiles();
  // Continues the journal that is held, or begins it, with tiles as it has them. Without a path
  // there is none.
  void open_journal(JournalHold* held);
  // Each tile that the journal does not have. False when the options' `stop` was set: what is
  // finished by then is in the journal, and a journal without any tile is removed.
  bool compute_tiles();
  SweepResult assemble_maps();
  // Deletes it, unless it is to be kept: the result is in a safe place.
  void close_journal();

  const Engines& engines() const { return engines_; }
  // The plan of the study with the states alone that it takes (plan/passive_states.hpp).
  const Plan& plan() const { return *plan_; }
  // What the planned tiles take.
  const ResourceEstimate& estimate() const { return estimate_; }

 private:
  const SteppedStudy& stepped_;
  const Study& study_;    // whose maps are made
  const Study computed_;  // with the states alone that it takes
  const SweepOptions& options_;
  Engines engines_;  // until the workers have them
  EngineInfo info_;  // of this process's engines
  std::optional<Plan> plan_;
  ResourceEstimate estimate_;
  std::optional<Journal> journal_;
  std::optional<Assembly> assembly_;
};

}  // namespace gearsweep
