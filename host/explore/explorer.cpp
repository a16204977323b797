#include "explore/explorer.hpp"

#include <algorithm>

#include "explore/view_result.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxScenes = 256;
constexpr int kOfTiles = 0, kOfMotions = 1;  // priorities

}  // namespace

Explorer::Explorer(ExploredStudy base, ExplorerOptions options)
    : base_(std::move(base)), options_(std::move(options)), cache_(options_.max_bytes) {
  if (options_.data) data_key_ = make_scene({})->key();
}

SweepOptions Explorer::sweep_options(int priority, const std::atomic<bool>* stop) const {
  SweepOptions options;
  options.devices = options_.devices;
  options.scheduler = scheduler_;
  options.priority = priority;
  options.stop = stop;
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
  std::optional<TileMaps> maps =
      compute_tile(scene, place, parent.get(), sweep_options(kOfTiles, &stop));
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

std::optional<Preview> Explorer::preview(const Scene& scene, const CellBlock& cells,
                                         const std::atomic<bool>& stop) {
  std::optional<Preview> preview = compute_preview(scene, cells, sweep_options(kOfTiles, &stop));
  if (!preview) return std::nullopt;
  const std::lock_guard lock(mutex_);
  // Few points at once are slower than many, and the first wait for their kernels: the last counts.
  preview_rate_ =
      static_cast<double>(preview->cells.count[0] * preview->cells.count[1]) / preview->seconds;
  return preview;
}

double Explorer::preview_rate() const {
  const double of_tiles = points_per_second();
  const std::lock_guard lock(mutex_);
  return std::max(preview_rate_, of_tiles);
}

const ResultData* Explorer::data(const Scene& scene) const {
  return options_.data && scene.key() == data_key_ ? &*options_.data : nullptr;
}

std::optional<PlaneDifference> Explorer::difference_of_curves(const Scene& scene) const {
  return options_.curves ? plane_difference(options_.curves->study, scene.study()) : std::nullopt;
}

std::optional<StripMaps> Explorer::strip(const Scene& scene, const Line& line, const Strip& strip,
                                         const std::atomic<bool>& stop) {
  return compute_strip(scene, line, strip, sweep_options(kOfTiles, &stop));
}

std::string Explorer::result_file(const Scene& scene, const ShareRange& view, std::size_t depth,
                                  const std::atomic<bool>& stop) {
  const std::lock_guard lock(one_file_);
  const auto find_tile = [&](const TilePlace& place) { return tile(scene, place, stop); };
  return view_result(scene, view, depth, find_tile, "gearsweep explore " + options_.source);
}

double Explorer::points_per_second() const {
  const std::lock_guard lock(mutex_);
  return seconds_ > 0.0 ? points_ / seconds_ : 0.0;
}

Motion Explorer::motion(const Scene& scene, const Cell& cell) {
  Motion motion = find_motion(scene, cell, sweep_options(kOfMotions));
  const std::lock_guard lock(one_spectrum_);
  add_spectrum(&motion);
  return motion;
}

MotionOrbit Explorer::orbit(const Scene& scene, const Cell& cell) {
  return find_motion_orbit(scene, cell, sweep_options(kOfMotions));
}

ReachedAttractors Explorer::starts(const Scene& scene, const Cell& cell, std::size_t count) {
  std::optional<ReachedAttractors> found =
      look_at_starts(scene, cell, count, sweep_options(kOfMotions));
  if (!found) throw RunError("interrupted");
  return *std::move(found);
}

BorderMotion Explorer::border(const Scene& scene, const CurvePlace& place) {
  return find_border_motion(scene, *options_.curves, place, sweep_options(kOfMotions));
}

void Explorer::prepare_motions(const Scene& scene) {
  const Cell middle = {1, {1, 1}};
  base_.state_ranges->of(base_.study);
  try {
    find_motion(scene, middle, sweep_options(kOfTiles));
    find_motion_orbit(scene, middle, sweep_options(kOfTiles));
  } catch (const std::runtime_error&) {
    return;
  }
}

}  // namespace gearsweep
