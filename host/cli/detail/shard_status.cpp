#include "cli/detail/shard_status.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "model/error.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnd = ".journal", kOf = "-of-";

// Reads the text K-of-N, which stands in the name: a shard whose step is still being found has not
// noted in its journal which it is.
std::optional<Shard> shard_in(std::string text) {
  const std::size_t of = text.find(kOf);
  if (of == std::string::npos) return std::nullopt;
  try {
    return parse_shard(text.replace(of, kOf.size(), "/"));
  } catch (const InputError&) {
    return std::nullopt;  // another file
  }
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
    if (!name.starts_with(begin) || !name.ends_with(kEnd)) continue;
    const std::optional<Shard> shard =
        shard_in(name.substr(begin.size(), name.size() - begin.size() - kEnd.size()));
    if (!shard) continue;
    const std::string journal = entry.path().string();
    shards.push_back({journal, *shard, Journal::status(journal)});
  }
  std::ranges::sort(shards, [](const ShardState& one, const ShardState& other) {
    return std::pair(one.shard.count, one.shard.number) <
           std::pair(other.shard.count, other.shard.number);
  });
  return shards;
}

}  // namespace gearsweep
