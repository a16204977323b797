// What the pages of one explorer share: the study that it was started with, scenes, tiles and
// devices.
#pragma once

#include <atomic>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/device_choice.hpp"
#include "explore/motion.hpp"
#include "explore/scene.hpp"
#include "explore/tile_cache.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct ExplorerOptions {
  std::string source;  // what the user called the study, for commands that he can give
  std::vector<DeviceChoice> devices = {};
  std::size_t max_bytes = std::size_t{512} << 20U;  // of tiles that are kept
};

// Threads may share one.
class Explorer {
 public:
  // base: explorable().
  Explorer(ExploredStudy base, ExplorerOptions options);

  const std::string& source() const { return options_.source; }

  // Throws InputError.
  std::shared_ptr<const Scene> make_scene(const SceneChanges& changes);
  // Null where it was never made, or too many were since.
  std::shared_ptr<const Scene> find_scene(const std::string& key) const;

  // Kept from before, or computed: nothing when stopped. Throws as compute_tile() does.
  std::shared_ptr<const TileMaps> tile(const Scene& scene, const TilePlace& place,
                                       const std::atomic<bool>& stop);
  // The points of all tiles by the time that they took; 0: there is none yet.
  double points_per_second() const;
  // Tiles wait for it between their rounds. Throws InputError and RunError.
  Motion motion(const Scene& scene, const Cell& cell);
  // Compiles what a motion takes, beside the tiles; whatever is wrong is left for motion() to say.
  void prepare_motions(const Scene& scene);

  // The memory of all tiles that are kept.
  std::size_t bytes() const { return cache_.bytes(); }
  Scheduler* scheduler() { return scheduler_.get(); }

 private:
  SweepOptions sweep_options(int priority) const;

  const ExploredStudy base_;
  const ExplorerOptions options_;
  const std::shared_ptr<Scheduler> scheduler_ = std::make_shared<Scheduler>();
  TileCache cache_;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<const Scene>> scenes_;  // the last made last
  double points_ = 0.0, seconds_ = 0.0;              // of tiles
  std::mutex one_motion_;                            // FFTW's planner is no two threads' at once
};

}  // namespace gearsweep
