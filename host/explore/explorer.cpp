#include "explore/explorer.hpp"

#include <algorithm>

namespace gearsweep {
namespace {

constexpr std::size_t kMaxScenes = 256;
constexpr int kOfNobody = -1, kOfTiles = 0, kOfMotions = 1;  // priorities

}  // namespace

Explorer::Explorer(ExploredStudy base, ExplorerOptions options)
    : base_(std::move(base)), options_(std::move(options)), cache_(options_.max_bytes) {}

SweepOptions Explorer::sweep_options(int priority) const {
  SweepOptions options;
  options.devices = options_.devices;
  options.scheduler = scheduler_;
  options.priority = priority;
  return options;
}

std::shared_ptr<const Scene> Explorer::make_scene(const SceneChanges& changes) {
  auto scene = std::make_shared<const Scene>(base_, changes);
  if (const auto known = find_scene(scene->key())) return known;
  const std::lock_guard lock(mutex_);
  scenes_.push_back(scene);
  if (scenes_.size() > kMaxScenes) scenes_.pop_front();
  return scene;
}

std::shared_ptr<const Scene> Explorer::find_scene(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::ranges::find_if(scenes_, [&](const auto& scene) { return scene->key() == key; });
  return found == scenes_.end() ? nullptr : *found;
}

std::shared_ptr<const TileMaps> Explorer::tile(const Scene& scene, const TilePlace& place,
                                               const std::atomic<bool>& stop) {
  const TileCache::Key key = {scene.key(), place};
  if (auto known = cache_.find(key)) return known;
  const auto parent = place.depth == 0 ? nullptr : cache_.find({scene.key(), place.parent()});
  SweepOptions options = sweep_options(kOfTiles);
  options.stop = &stop;
  std::optional<TileMaps> maps = compute_tile(scene, place, parent.get(), options);
  if (!maps) return nullptr;
  {
    const std::lock_guard lock(mutex_);
    // The first tiles, and others whose kernels are compiled first, must not count for ever.
    constexpr double kForget = 0.8;
    points_ = kForget * points_ + static_cast<double>(maps->computed);
    seconds_ = kForget * seconds_ + maps->seconds;
  }
  return cache_.keep(key, *std::move(maps));
}

double Explorer::points_per_second() const {
  const std::lock_guard lock(mutex_);
  return seconds_ > 0.0 ? points_ / seconds_ : 0.0;
}

Motion Explorer::motion(const Scene& scene, const Cell& cell) {
  const std::lock_guard lock(one_motion_);
  return find_motion(scene, cell, sweep_options(kOfMotions));
}

void Explorer::prepare_motions(const Scene& scene) {
  const std::lock_guard lock(one_motion_);
  const Cell middle = {1, {1, 1}};
  try {
    find_motion(scene, middle, sweep_options(kOfNobody));
  } catch (const std::runtime_error&) {
    return;
  }
}

}  // namespace gearsweep
