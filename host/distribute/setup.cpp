#include "distribute/setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "distribute/cluster_crew.hpp"
#include "distribute/make_engine.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

using Engines = std::vector<std::unique_ptr<Engine>>;

// What the engines say of themselves, each thing once.
EngineInfo describe(const Engines& engines) {
  const auto joined = [&](std::string EngineInfo::*member) {
    std::set<std::string> distinct;
    for (const std::unique_ptr<Engine>& engine : engines) distinct.insert(engine->info().*member);
    return fmt::format("{}", fmt::join(distinct, "; "));
  };
  return {joined(&EngineInfo::device), joined(&EngineInfo::driver), joined(&EngineInfo::macros)};
}

std::unique_ptr<Crew> make_crew(const Plan& plan, Engines engines, Cluster* cluster) {
  if (cluster == nullptr) return std::make_unique<LocalCrew>(plan, std::move(engines));
  return std::make_unique<ClusterCrew>(plan, std::move(engines), cluster);
}

// The least points that keep an engine busy, for all of them.
std::size_t least_tile(const Engines& engines) {
  std::size_t least = 1;
  for (const std::unique_ptr<Engine>& engine : engines) {
    least = std::max(least, engine->least_tile());
  }
  return least;
}

// Points of a tile. Enough tiles that an interruption keeps most of a long run, unless that would
// starve an engine; what suits all of them. Each of the processes of a sweep has so many engines.
// Shards are cut by the study alone: each may run on a machine of its own kind.
std::size_t tile_size(const Study& study, const Engines& engines, const Shard& shard,
                      std::size_t processes) {
  constexpr std::size_t kTiles = 16;  // for each engine
  constexpr std::size_t kMostOfShard = 16384, kLeastOfShard = 256;
  if (study.integrate.tile > 0) return study.integrate.tile;
  std::size_t most = study.trajectories();
  for (const std::unique_ptr<Engine>& engine : engines) {
    most = std::min(most, engine->preferred_tile());
  }
  if (shard.count > 0) {
    most = std::min(most, kMostOfShard);
    return std::clamp(study.trajectories() / (kTiles * shard.count), std::min(kLeastOfShard, most),
                      most);
  }
  return std::clamp(study.trajectories() / (kTiles * engines.size() * processes),
                    std::min(least_tile(engines), most), most);
}

// Smaller tiles where each would take so long that an interruption hurts (half a minute or so on a
// few cores).
std::size_t quick_tile_size(const Plan& plan, std::size_t least) {
  constexpr double kMostWork = 1e10;  // steps
  const std::size_t size = plan.tile_points();
  if (plan.study().integrate.tile > 0) return size;
  const double work_of_point = plan.total_work() / static_cast<double>(plan.study().trajectories());
  const double quick = kMostWork / work_of_point;
  if (quick >= static_cast<double>(size)) return size;
  return std::max(static_cast<std::size_t>(quick), std::min(size, least));
}

std::size_t points_of(const Plan& plan, const Shard& shard) {
  const std::vector<const Tile*> tiles = tiles_of(plan);
  std::size_t points = 0;
  for (std::size_t number = 0; number < tiles.size(); ++number) {
    if (shard.has(number)) points += tiles[number]->points.size();
  }
  return points;
}

}  // namespace

Identity identity_of(const Study& study, const Shard& shard) {
  Identity identity = {{notes::kStudy, study.toml},
                       {"kernels and formulas", source_hash()},
                       {notes::kStep, fmt::format("{}", study.integrate.max_step)}};
  if (shard.count > 0) {
    identity.emplace_back(notes::kShard, fmt::format("{}/{}", shard.number, shard.count));
  }
  return identity;
}

Setup::Setup(const Study& study, const Shard& shard, const SweepOptions& options) {
  Engines engines = make_engines(study, options.devices, options.on_trouble);
  info = describe(engines);
  const auto processes =
      static_cast<std::size_t>(options.cluster == nullptr ? 1 : options.cluster->size());
  // Refuses what cannot be planned.
  plan.emplace(study, tile_size(study, engines, shard, processes));
  std::size_t tile_points = quick_tile_size(*plan, shard.count > 0 ? 1 : least_tile(engines));
  if (!options.journal_path.empty()) {
    Identity identity = identity_of(study, shard);
    if (options.strict_device) {
      identity.emplace_back("device", info.device);
      identity.emplace_back("driver", info.driver);
      identity.emplace_back("build options", info.macros);
    }
    journal.emplace(options.journal_path, identity);
    // A run that goes on keeps the cut, whatever devices it has now.
    tile_points = read_count(journal->keep(notes::kTilePoints, std::to_string(tile_points)), 1);
  }
  if (plan->tile_points() != tile_points) plan.emplace(study, tile_points);
  if (journal) {
    journal->keep(notes::kPoints, std::to_string(points_of(*plan, shard)));
    journal->keep(notes::kDriver, info.driver);
    journal->keep(notes::kBuildOptions, info.macros);
    for (const auto& [name, value] : options.notes) journal->keep(name, value);
  }
  crew = make_crew(*plan, std::move(engines), options.cluster);
}

}  // namespace gearsweep
