// What a sweep needs before its first tile: engines, plan, journal, crew.
#pragma once

#include <memory>
#include <optional>

#include "journal/journal.hpp"
#include "journal/notes.hpp"
#include "sweep/sweep_options.hpp"
#include "workers/shard.hpp"
#include "workers/worker_pool.hpp"

namespace gearsweep {

// What the parts of a sweep must have in common for one to continue another's journal, and for
// shards to be merged.
Identity identity_of(const Study& study, const Shard& shard);

struct Setup {
  EngineInfo info;  // of this process's engines
  std::optional<Plan> plan;
  std::optional<Journal> journal;
  std::unique_ptr<Crew> crew;

  // study: its steps are known (no tolerance, or the pilot has run). Throws as run_sweep() does.
  Setup(const Study& study, const Shard& shard, const SweepOptions& options);
  Journal* journal_or_null() { return journal ? &*journal : nullptr; }
};

}  // namespace gearsweep
