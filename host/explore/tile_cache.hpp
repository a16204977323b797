// Tiles that were computed, the least recently used left out where they are too many.
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "explore/tile_maps.hpp"

namespace gearsweep {

// Threads may share one.
class TileCache {
 public:
  using Key = std::pair<std::string, TilePlace>;  // Scene::key()

  explicit TileCache(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  // Null where there is none.
  std::shared_ptr<const TileMaps> find(const Key& key);
  std::shared_ptr<const TileMaps> keep(const Key& key, TileMaps maps);
  std::size_t bytes() const;

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const TileMaps> maps;
  };

  const std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::list<Entry> entries_;  // the last used first
  std::map<Key, std::list<Entry>::iterator> by_key_;
  std::size_t bytes_ = 0;
};

}  // namespace gearsweep
