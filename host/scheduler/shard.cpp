#include "scheduler/shard.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"

namespace gearsweep {

Shard parse_shard(const std::string& text) {
  constexpr std::size_t kMaxShards = 1'000'000;
  const std::size_t slash = text.find('/');
  const bool has_digits_only =
      slash != std::string::npos && text.size() < 20 &&
      (text.substr(0, slash) + text.substr(slash + 1)).find_first_not_of("0123456789") ==
          std::string::npos &&
      slash > 0 && slash + 1 < text.size();
  Shard shard;
  if (has_digits_only) shard = {std::stoul(text), std::stoul(text.substr(slash + 1))};
  if (shard.number < 1 || shard.number > shard.count || shard.count > kMaxShards) {
    throw InputError(
        fmt::format("shard '{}': expected K/N, the K-th of N shards, such as 1/8 .. 8/8", text));
  }
  return shard;
}

std::size_t tile_for_shards(std::size_t trajectories, std::size_t count) {
  constexpr std::size_t kTiles = 4;
  return std::max<std::size_t>(1, trajectories / (kTiles * count));
}

}  // namespace gearsweep
