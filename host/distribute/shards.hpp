// A sweep in parts that know nothing of each other, for job arrays without MPI.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "distribute/sweep.hpp"

namespace gearsweep {

// One of `count` parts of a sweep: every count-th tile.
struct Shard {
  std::size_t number = 1;  // 1 to count
  std::size_t count = 0;   // 0: no parts, the whole sweep

  bool has(std::size_t tile) const { return count == 0 || tile % count == number - 1; }
};

// "2/8". Throws InputError.
Shard parse_shard(const std::string& text);

// Computes the tiles of one shard into the journal, which stays. False when `stop` was set; what is
// finished by then is kept, as ever. Nothing is delivered. Throws as run_sweep() does; InputError,
// too, for a study that goes along chains, whose tiles need each other.
bool run_shard(const Study& study, const Shard& shard, const SweepOptions& options);

// The maps of the sweep whose shards these journals hold; they stay. Throws InputError when shards
// are missing, not finished, or of different sweeps.
SweepResult merge_shards(const std::vector<std::string>& journals);

}  // namespace gearsweep
