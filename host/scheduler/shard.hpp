// One part of a sweep whose parts know nothing of each other.
#pragma once

#include <cstddef>
#include <string>

namespace gearsweep {

// One of `count` parts of a sweep: every count-th tile.
struct Shard {
  std::size_t number = 1;  // 1 to count
  std::size_t count = 0;   // 0: no parts, the whole sweep

  bool has(std::size_t tile) const { return count == 0 || tile % count == number - 1; }
};

// "2/8". Throws InputError.
Shard parse_shard(const std::string& text);

// How many trajectories a tile of a sweep in `count` shards has that run on machines of different
// kinds, which would each cut it in their own way: a shard has four tiles then.
std::size_t tile_for_shards(std::size_t trajectories, std::size_t count);

}  // namespace gearsweep
