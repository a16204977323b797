// Runs a study: plans it, computes tile after tile, journals each, assembles the maps.
#pragma once

#include <optional>

#include "sweep/sweep_options.hpp"

namespace gearsweep {

// Nothing when `stop` was set. Throws InputError (bad study or device), or RunError when a file
// cannot be written or the last device has failed.
std::optional<SweepResult> run_sweep(const Study& study, const SweepOptions& options);

}  // namespace gearsweep
