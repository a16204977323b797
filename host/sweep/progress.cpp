#include "sweep/progress.hpp"

#include <algorithm>

#include "scheduler/worker_pool.hpp"

namespace gearsweep {

Progress::Progress(const Plan& plan, const SweepOptions& options)
    : options_(options), start_(std::chrono::steady_clock::now()) {
  const std::vector<const Tile*> tiles = tiles_of(plan);
  for (std::size_t number = 0; number < tiles.size(); ++number) {
    if (!options.shard.has(number)) continue;
    total_ += tiles[number]->work;
    progress_.points += tiles[number]->points.size();
  }
}

void Progress::begin_tile(std::size_t number, const Tile& tile) {
  running_[number] = {tile.work, tile.work, 0.0};
}

void Progress::add_steps(std::size_t number, double steps) {
  running_[number].taken += steps;
  tell();
}

void Progress::add_work(std::size_t number, double steps) { running_[number].expected += steps; }

void Progress::drop_tile(std::size_t number) { running_.erase(number); }

void Progress::tile_done(std::size_t number, const Tile& tile, bool resumed) {
  running_.erase(number);
  done_ += tile.work;
  progress_.points_done += tile.points.size();
  progress_.share_kept = done_ / total_;
  if (resumed) {
    progress_.points_resumed += tile.points.size();
    progress_.share_resumed += tile.work / total_;
  }
  tell();
}

void Progress::tell() {
  double done = done_;
  for (const auto& [number, tile] : running_) {
    // A phase grid may hold a few steps more than the plan counted.
    if (tile.planned > 0.0) done += std::min(1.0, tile.taken / tile.expected) * tile.planned;
  }
  progress_.share = std::max(progress_.share, total_ > 0.0 ? done / total_ : 1.0);
  progress_.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (options_.on_progress) options_.on_progress(progress_);
}

}  // namespace gearsweep
