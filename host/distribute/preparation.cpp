#include "distribute/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "distribute/cluster.hpp"
#include "distribute/make_engine.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

// Points of a tile. Enough tiles that an interruption keeps most of a long run, unless that would
// starve an engine; what suits all of them.
std::size_t wanted_tile(const Study& study, const Engines& engines, const SweepOptions& options) {
  constexpr std::size_t kTiles = 32;
  if (study.integrate.tile > 0) return study.integrate.tile;
  std::size_t least = 1;
  std::size_t most = study.trajectories();
  for (const std::unique_ptr<Engine>& engine : engines) {
    least = std::max(least, engine->least_tile());
    most = std::min(most, engine->preferred_tile());
  }
  const auto processes =
      static_cast<std::size_t>(options.cluster == nullptr ? 1 : options.cluster->size());
  return std::clamp(study.trajectories() / (kTiles * engines.size() * processes),
                    std::min(least, most), most);
}

InputError does_not_fit(const StudyNeeds& needs, const std::string& what) {
  std::string devices;
  for (const DeviceNeeds& device : needs.devices) {
    devices +=
        fmt::format("\n  {}: {} of {}, in one buffer {} of {}", device.name,
                    format_bytes(device.tile.device), format_bytes(device.memory.all),
                    format_bytes(device.tile.buffer), format_bytes(device.memory.one_buffer));
  }
  return InputError(fmt::format("{}; beside them, they need {} of the machine's memory:{}", what,
                                format_bytes(needs.tiles), devices));
}

}  // namespace

Preparation prepare_sweep(const Study& study, const SweepOptions& options) {
  // Before the engines, which take a moment, and the plan, which is as large as the study.
  refuse_too_large(needs_of_study(study, options.delivery, options.journal_path),
                   options.journal_path);
  Preparation ready;
  ready.engines = make_engines(study, options.devices, options.on_trouble);
  std::size_t points = std::min(wanted_tile(study, ready.engines, options), study.trajectories());
  while (true) {
    ready.plan.emplace(study, points);
    ready.needs = needs_of_plan(*ready.plan, ready.engines, options.delivery, options.journal_path);
    const double strain = strain_of_tile(ready.needs);
    if (strain <= 1.0) break;
    if (points == 1) {
      throw does_not_fit(ready.needs,
                         "a tile of a single point does not fit the devices: sample fewer states "
                         "(observe.poincare) or periods (integrate.record)");
    }
    // A little less than in proportion: tables of phase grids and spare lanes stay.
    constexpr double kMargin = 0.9;
    const double fitting = kMargin * static_cast<double>(points) / strain;
    points = std::clamp<std::size_t>(static_cast<std::size_t>(fitting), 1, points - 1);
  }
  refuse_too_large(ready.needs, options.journal_path);
  return ready;
}

Plan plan_as_kept(const Study& study, std::size_t tile_points, const Engines& engines,
                  const SweepOptions& options) {
  Plan plan(study, tile_points);
  const StudyNeeds needs = needs_of_plan(plan, engines, options.delivery, options.journal_path);
  if (strain_of_tile(needs) > 1.0) {
    throw does_not_fit(needs, fmt::format("'{}' was begun with tiles of {} points, which do not "
                                          "fit here: continue on another device, or start afresh "
                                          "(--restart)",
                                          options.journal_path, tile_points));
  }
  return plan;
}

}  // namespace gearsweep
