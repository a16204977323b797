#include "sweep/run_context.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "model/error.hpp"
#include "model/version.hpp"
#include "plan/passive_states.hpp"
#include "scheduler/cluster_workers.hpp"
#include "scheduler/make_engine.hpp"
#include "sweep/tile_loop.hpp"

namespace gearsweep {
namespace {

// What the engines say of themselves, each thing once.
EngineInfo describe(const Engines& engines) {
  const auto joined = [&](std::string EngineInfo::*field) {
    std::set<std::string> distinct;
    for (const std::unique_ptr<Engine>& engine : engines) distinct.insert(engine->info().*field);
    return fmt::format("{}", fmt::join(distinct, "; "));
  };
  return {joined(&EngineInfo::device), joined(&EngineInfo::driver), joined(&EngineInfo::macros)};
}

std::unique_ptr<WorkerPool> start_workers(const Plan& plan, Engines engines, Task* task,
                                          Cluster* cluster) {
  if (cluster == nullptr) return std::make_unique<ThreadWorkers>(plan, std::move(engines), task);
  return std::make_unique<ClusterWorkers>(plan, std::move(engines), task, cluster);
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

// As a note of a journal.
std::string pack(const PilotFindings& pilot) {
  std::string text =
      fmt::format("{} {} {} {} {} {} {}", pilot.step.max_step, pilot.step.orbit_steps, pilot.error,
                  pilot.kept, pilot.sensitive, pilot.max_sensitive, pilot.points);
  for (const auto& [quantity, error] : pilot.errors) text += fmt::format(" {} {}", quantity, error);
  return text;
}

}  // namespace

std::string why_no_shards(const Study& study) {
  if (study.stages() <= 1) return "";
  return fmt::format(
      "{}, so the shards would need each other; start it under mpirun or srun instead",
      study.is_chained() ? "initial.policy makes points start where their neighbours end"
                         : "uncertain.start makes draws start where nominal motions end");
}

Identity identity_of(const Study& study, const Shard& shard) {
  Identity identity = {{notes::kStudy, study.toml},
                       {"kernels and formulas", source_hash()},
                       {notes::kStep, fmt::format("{}", study.integrate.max_step)},
                       {notes::kOrbitSteps, fmt::format("{}", study.integrate.orbit_steps)}};
  if (shard.count > 0) {
    identity.emplace_back(notes::kShard, fmt::format("{}/{}", shard.number, shard.count));
  }
  return identity;
}

RunContext::RunContext(const SteppedStudy& stepped, const SweepOptions& options)
    : stepped_(stepped),
      study_(stepped.study),
      computed_(without_passive_states(study_)),
      options_(options) {
  const std::string wrong = options.shard.count > 0 ? why_no_shards(study_) : "";
  if (!wrong.empty()) throw InputError("--shard: " + wrong);
}

void RunContext::find_engines() {
  // Before the engines, which take a moment, and the plan, which is as large as the study.
  refuse_too_large(estimate_of_study(study_, options_.delivery, options_.journal_path),
                   options_.journal_path);
  engines_ = make_engines(computed_, options_.devices, options_.scheduler.get(), options_.warn);
  info_ = describe(engines_);
}

void RunContext::plan_tiles() {
  plan_.emplace(plan_that_fits(computed_, engines_, options_));
  estimate_ = estimate_of_plan(*plan_, engines_, options_.delivery, options_.journal_path);
  refuse_too_large(estimate_, options_.journal_path);
}

void RunContext::open_journal(JournalHold* held) {
  if (options_.journal_path.empty()) return;
  const Identity machine = machine_of(info_);
  Identity identity = identity_of(study_, options_.shard);
  if (options_.strict_device) identity.insert(identity.end(), machine.begin(), machine.end());
  journal_.emplace(held, identity);
  // A run that goes on keeps the cut, whatever devices it has now.
  const std::string kept = journal_->note(notes::kTilePoints);
  const std::size_t tile_points = kept.empty() ? plan_->tile_points() : read_count(kept, 1);
  if (plan_->tile_points() != tile_points) {
    plan_.emplace(plan_as_kept(computed_, tile_points, engines_, options_));
  }
  std::map<std::string, std::string> all = options_.notes;
  all[notes::kTilePoints] = std::to_string(tile_points);
  all[notes::kPoints] = std::to_string(points_of(*plan_, options_.shard));
  if (stepped_.pilot) all[notes::kPilot] = pack(*stepped_.pilot);
  for (const auto& [name, value] : machine) all[name] = with_value(journal_->note(name), value);
  journal_->keep(all);
}

bool RunContext::compute_tiles() {
  Task task(options_.scheduler, options_.priority);
  const std::unique_ptr<WorkerPool> workers =
      start_workers(*plan_, std::move(engines_), &task, options_.cluster);
  Journal* journal = journal_ ? &*journal_ : nullptr;
  assembly_.emplace(study_, computed_.model->states.size());
  if (TileLoop(*plan_, options_, workers.get(), journal, &*assembly_).run()) return true;
  if (journal != nullptr && journal->finished_tiles() == 0) journal->remove();
  return false;
}

SweepResult RunContext::assemble_maps() {
  SweepResult result = assembly_->take();
  result.engine.driver = info_.driver;
  result.engine.macros = info_.macros;
  result.integrated = computed_.model->state_names();
  result.pilot = stepped_.pilot;
  return result;
}

void RunContext::close_journal() {
  if (journal_ && !options_.keep_journal) journal_->remove();
}

}  // namespace gearsweep
