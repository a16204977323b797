// The shards of a sweep put together.
#pragma once

#include <string>
#include <vector>

#include "engine/result.hpp"

namespace gearsweep {

// The maps of the sweep whose shards (SweepOptions::shard) these journals hold; they stay. Throws
// InputError when shards are missing, not finished, or of different sweeps.
SweepResult merge_shards(const std::vector<std::string>& journals);

}  // namespace gearsweep
