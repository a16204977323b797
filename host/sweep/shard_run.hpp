// A sweep in parts that know nothing of each other, for job arrays without MPI.
#pragma once

#include <string>
#include <vector>

#include "sweep/sweep_options.hpp"
#include "workers/shard.hpp"

namespace gearsweep {

// Computes the tiles of one shard into the journal, which stays. False when `stop` was set; what is
// finished by then is kept, as ever. Nothing is delivered. Throws as run_sweep() does; InputError,
// too, for a study that goes along chains, whose tiles need each other.
bool run_shard(const Study& study, const Shard& shard, const SweepOptions& options);

// The maps of the sweep whose shards these journals hold; they stay. Throws InputError when shards
// are missing, not finished, or of different sweeps.
SweepResult merge_shards(const std::vector<std::string>& journals);

}  // namespace gearsweep
