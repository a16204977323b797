// How far the shards of a result are.
#pragma once

#include <string>
#include <vector>

#include "journal/journal.hpp"
#include "scheduler/shard.hpp"

namespace gearsweep {

struct ShardState {
  std::string journal;  // its path
  Shard shard;
  JournalStatus status;
};

// The journals OUT.nc.shard-K-of-N.journal of a result, in the order of their numbers. Throws
// InputError for a file of this name that is no journal.
std::vector<ShardState> shards_of(const std::string& output);

}  // namespace gearsweep
