// Runs a study, told in the order of its steps.
#pragma once

#include <optional>

#include "sweep/sweep_options.hpp"

namespace gearsweep {

// Computes the maps and delivers them. Nothing when `stop` was set: what is finished by then is in
// the journal. Throws InputError (bad study or device), or RunError when a file cannot be written
// or the last device has failed.
std::optional<SweepResult> run_sweep(const Study& study, const SweepOptions& options);

// Computes one shard of the study into its journal (SweepOptions::shard). False when `stop` was
// set. Throws as run_sweep().
bool run_shard(const Study& study, const SweepOptions& options);

}  // namespace gearsweep
