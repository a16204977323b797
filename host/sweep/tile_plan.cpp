#include "sweep/tile_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/error.hpp"
#include "scheduler/cluster.hpp"

namespace gearsweep {
namespace {

// The minimum number of points that keeps every engine busy.
std::size_t min_tile(const Engines& engines) {
  std::size_t min = 1;
  for (const std::unique_ptr<Engine>& engine : engines) {
    min = std::max(min, engine->min_tile());
  }
  return min;
}

// Points of a tile. Large ones, since each takes as many launches as another; but every engine has
// some, unless that would starve it. What suits all engines. Each of the processes of a sweep has
// so many engines. Shards are cut by the study alone: each may run on a machine of its own kind.
std::size_t tile_size(const Study& study, const Engines& engines, const Shard& shard,
                      std::size_t processes) {
  constexpr std::size_t kTiles = 2;  // for each engine
  constexpr std::size_t kMaxOfShard = 16384, kMinOfShard = 256;
  if (study.integrate.tile > 0) return study.integrate.tile;
  std::size_t most = study.trajectories();
  for (const std::unique_ptr<Engine>& engine : engines) {
    most = std::min(most, engine->preferred_tile());
  }
  if (shard.count > 0) {
    most = std::min(most, kMaxOfShard);
    return std::clamp(study.trajectories() / (kTiles * shard.count), std::min(kMinOfShard, most),
                      most);
  }
  return std::clamp(study.trajectories() / (kTiles * engines.size() * processes),
                    std::min(min_tile(engines), most), most);
}

// Smaller tiles where each would take so long that an interruption hurts: half a minute or so on
// two cores, which have some 256 points in flight. A device with more of them does more in that
// time.
std::size_t quick_tile_size(const Plan& plan, std::size_t min) {
  constexpr double kMaxWorkInFlight = 4e7;  // steps of each point in flight
  const double max_work = kMaxWorkInFlight * std::max(256.0, static_cast<double>(min));
  const std::size_t size = plan.tile_points();
  if (plan.study().integrate.tile > 0) return size;
  const double work_of_point = plan.total_work() / static_cast<double>(plan.study().trajectories());
  const double quick = max_work / work_of_point;
  if (quick >= static_cast<double>(size)) return size;
  return std::max(static_cast<std::size_t>(quick), std::min(size, min));
}

InputError does_not_fit(const ResourceEstimate& estimate, const std::string& what) {
  std::string devices;
  for (const DeviceEstimate& device : estimate.devices) {
    devices +=
        fmt::format("\n  {}: {} of {}, in one buffer {} of {}", device.name,
                    format_bytes(device.tile.device), format_bytes(device.memory.all),
                    format_bytes(device.tile.buffer), format_bytes(device.memory.one_buffer));
  }
  return InputError(fmt::format("{}; beside them, they need {} of the machine's memory:{}", what,
                                format_bytes(estimate.tiles), devices));
}

}  // namespace

Plan plan_that_fits(const Study& study, const Engines& engines, const SweepOptions& options) {
  const auto processes =
      static_cast<std::size_t>(options.cluster == nullptr ? 1 : options.cluster->size());
  Plan plan(study, tile_size(study, engines, options.shard, processes));
  std::size_t points = quick_tile_size(plan, options.shard.count > 0 ? 1 : min_tile(engines));
  points = std::min(points, study.trajectories());
  while (true) {
    if (plan.tile_points() != points) plan.cut(points);
    const ResourceEstimate estimate =
        estimate_of_plan(plan, engines, options.delivery, options.journal_path);
    const double share = tile_memory_share(estimate);
    if (share <= 1.0) return plan;
    if (points == 1) {
      throw does_not_fit(estimate,
                         "a tile of a single point does not fit the devices: sample fewer states "
                         "(observe.poincare) or periods (integrate.record)");
    }
    // A little less than in proportion: tables of phase grids and spare lanes stay.
    constexpr double kMargin = 0.9;
    const double fitting = kMargin * static_cast<double>(points) / share;
    points = std::clamp<std::size_t>(static_cast<std::size_t>(fitting), 1, points - 1);
  }
}

Plan plan_as_kept(const Study& study, std::size_t tile_points, const Engines& engines,
                  const SweepOptions& options) {
  Plan plan(study, tile_points);
  const ResourceEstimate estimate =
      estimate_of_plan(plan, engines, options.delivery, options.journal_path);
  if (tile_memory_share(estimate) > 1.0) {
    throw does_not_fit(estimate,
                       fmt::format("'{}' was begun with tiles of {} points, which do not "
                                   "fit here: continue on another device, or start afresh "
                                   "(--restart)",
                                   options.journal_path, tile_points));
  }
  return plan;
}

}  // namespace gearsweep
