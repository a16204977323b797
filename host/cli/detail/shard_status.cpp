#include "cli/detail/shard_status.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "journal/notes.hpp"
#include "scheduler/shard.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

std::size_t number_of(const ShardState& state) {
  return state.shard.empty() ? 0 : parse_shard(state.shard).number;
}

}  // namespace

std::vector<ShardState> shards_of(const std::string& output) {
  const fs::path path(output);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string begin = path.filename().string() + ".shard-";
  std::vector<ShardState> shards;
  std::error_code no_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, no_folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin) || !name.ends_with(".journal")) continue;
    ShardState state{entry.path().string(), "", Journal::status(entry.path().string())};
    const auto note = state.status.notes.find(notes::kShard);
    if (note != state.status.notes.end()) state.shard = note->second;
    shards.push_back(std::move(state));
  }
  std::ranges::sort(shards, [](const ShardState& one, const ShardState& other) {
    return std::pair(number_of(one), one.journal) < std::pair(number_of(other), other.journal);
  });
  return shards;
}

}  // namespace gearsweep
