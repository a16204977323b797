#include "explore/tile_cache.hpp"

namespace gearsweep {

std::shared_ptr<const TileMaps> TileCache::find(const Key& key) {
  const std::lock_guard lock(mutex_);
  const auto found = by_key_.find(key);
  if (found == by_key_.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, found->second);
  return found->second->maps;
}

std::shared_ptr<const TileMaps> TileCache::keep(const Key& key, TileMaps maps) {
  const auto shared = std::make_shared<const TileMaps>(std::move(maps));
  const std::lock_guard lock(mutex_);
  if (const auto found = by_key_.find(key); found != by_key_.end()) return found->second->maps;
  entries_.push_front({key, shared});
  by_key_[key] = entries_.begin();
  bytes_ += bytes_of(*shared);
  while (bytes_ > max_bytes_ && entries_.size() > 1) {
    bytes_ -= bytes_of(*entries_.back().maps);
    by_key_.erase(entries_.back().key);
    entries_.pop_back();
  }
  return shared;
}

std::size_t TileCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace gearsweep
