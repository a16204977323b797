// Counts what is done of a sweep and tells the caller.
#pragma once

#include <chrono>
#include <map>

#include "plan/plan.hpp"
#include "sweep/sweep_options.hpp"
#include "workers/shard.hpp"

namespace gearsweep {

class Progress {
 public:
  Progress(const Plan& plan, const Shard& shard, const SweepOptions& options);

  void begin_tile(std::size_t number, const Tile& tile);
  void add_steps(std::size_t number, double steps);
  // A running tile turns out to take so many steps more than were planned (fewer: negative).
  void add_work(std::size_t number, double steps);
  // Its steps count for nothing.
  void drop_tile(std::size_t number);
  void tile_done(std::size_t number, const Tile& tile, bool resumed);

 private:
  struct Running {
    double planned = 0.0, expected = 0.0, taken = 0.0;  // steps
  };
  void tell();

  const SweepOptions& options_;
  double total_ = 0.0;
  double done_ = 0.0;  // of the total, in finished tiles
  std::map<std::size_t, Running> running_;
  SweepProgress progress_;
  const std::chrono::steady_clock::time_point start_;
};

}  // namespace gearsweep
