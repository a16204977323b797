#include "sweep/setup.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "model/version.hpp"
#include "sweep/preparation.hpp"
#include "workers/cluster_workers.hpp"

namespace gearsweep {
namespace {

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

Identity machine_of(const EngineInfo& info) {
  return {{notes::kDevice, info.device},
          {notes::kDriver, info.driver},
          {notes::kBuildOptions, info.macros}};
}

// A note of several values with one more, unless it is there.
std::string with_value(const std::string& note, const std::string& value) {
  constexpr const char* kBetween = "; then ";
  if (note.empty()) return value;
  const bool is_there =
      (kBetween + note + kBetween).find(kBetween + value + kBetween) != std::string::npos;
  return is_there ? note : note + kBetween + value;
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
  Preparation ready = prepare_sweep(study, options, shard);
  info = describe(ready.engines);
  plan.emplace(*std::move(ready.plan));
  std::size_t tile_points = plan->tile_points();
  if (!options.journal_path.empty()) {
    Identity identity = identity_of(study, shard);
    if (options.strict_device) {
      const Identity machine = machine_of(info);
      identity.insert(identity.end(), machine.begin(), machine.end());
    }
    journal.emplace(options.journal_path, identity);
    // A run that goes on keeps the cut, whatever devices it has now.
    const std::string kept = journal->note(notes::kTilePoints);
    if (!kept.empty()) tile_points = read_count(kept, 1);
  }
  if (plan->tile_points() != tile_points) {
    plan.emplace(plan_as_kept(study, tile_points, ready.engines, options));
  }
  if (journal) {
    std::map<std::string, std::string> kept = options.notes;
    kept[notes::kTilePoints] = std::to_string(tile_points);
    kept[notes::kPoints] = std::to_string(points_of(*plan, shard));
    for (const auto& [name, value] : machine_of(info)) {
      kept[name] = with_value(journal->note(name), value);
    }
    journal->keep(kept);
  }
  crew = make_crew(*plan, std::move(ready.engines), options.cluster);
}

}  // namespace gearsweep
