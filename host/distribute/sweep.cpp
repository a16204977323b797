#include "distribute/sweep.hpp"

#include <fmt/format.h>

#include <chrono>

#include "distribute/assembly.hpp"
#include "distribute/make_engine.hpp"
#include "distribute/pilot.hpp"
#include "distribute/tile_run.hpp"
#include "journal/journal.hpp"
#include "model/version.hpp"

namespace gearsweep {
namespace {

// What two runs must have in common for one to continue the other's journal.
std::string fingerprint(const Study& study, const EngineInfo& engine, std::size_t tile_points) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\ntile {}\nstep {}", study.toml, source_hash(),
                     engine.device, engine.driver, engine.macros, tile_points,
                     study.integrate.max_step);
}

// Points of a tile. Enough tiles that an interruption keeps most of a long run, unless that would
// starve the engine.
std::size_t tile_size(const Study& study, const Engine& engine) {
  constexpr std::size_t kTiles = 32;
  if (study.integrate.tile > 0) return study.integrate.tile;
  return std::clamp(study.trajectories() / kTiles, engine.least_tile(), engine.preferred_tile());
}

// Counts what is done and tells the caller.
class Progress {
 public:
  Progress(const Plan& plan, const SweepOptions& options)
      : total_(plan.total_work()), options_(options), start_(std::chrono::steady_clock::now()) {
    progress_.points = plan.study().trajectories();
  }

  void begin_tile(const Tile& tile) {
    planned_ = expected_ = tile.work;
    partial_ = 0.0;
  }

  // The running tile turns out to take so many steps more than were planned.
  void add_work(double steps) { expected_ += steps; }

  // false when the sweep is to stop. `steps` of the running tile are done.
  bool round(double steps) {
    partial_ += steps;
    tell();
    return options_.stop == nullptr || !*options_.stop;
  }

  void tile_done(const Tile& tile, bool resumed) {
    done_ += tile.work;
    planned_ = 0.0;
    progress_.points_done += tile.points.size();
    progress_.share_kept = done_ / total_;
    if (resumed) {
      progress_.points_resumed += tile.points.size();
      progress_.share_resumed += tile.work / total_;
    }
    tell();
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  void tell() {
    // A phase grid may hold a few steps more than the plan counted.
    const double of_tile = planned_ > 0.0 ? std::min(1.0, partial_ / expected_) : 0.0;
    const double share = total_ > 0.0 ? (done_ + of_tile * planned_) / total_ : 1.0;
    progress_.share = std::max(progress_.share, share);
    progress_.seconds = seconds();
    if (options_.on_progress) options_.on_progress(progress_);
  }

  double total_, done_ = 0.0;
  double planned_ = 0.0, expected_ = 0.0, partial_ = 0.0;  // steps of the running tile
  SweepProgress progress_;
  const SweepOptions& options_;
  std::chrono::steady_clock::time_point start_;
};

// A tile's result with what it took; nothing when stopped.
std::optional<TileResult> compute_tile(const Plan& plan, const Tile& tile,
                                       const std::vector<double>& initial, Engine* engine,
                                       Progress* progress) {
  progress->begin_tile(tile);
  double steps = 0.0;
  const double start = progress->seconds();
  const double in_kernels = engine->kernel_seconds();
  TileCallbacks callbacks;
  callbacks.after_round = [&](double round_steps) {
    steps += round_steps;
    return progress->round(round_steps);
  };
  callbacks.on_work = [&](double more) { progress->add_work(more); };
  std::optional<TileResult> result = run_tile(plan, tile, initial, engine, callbacks);
  if (!result) return std::nullopt;
  result->effort[0] = steps;
  result->effort[1] = progress->seconds() - start;
  result->effort[3] = engine->kernel_seconds() - in_kernels;
  // Only neighbours in a chain ask for them again.
  if (!plan.study().is_chained()) result->final_states.clear();
  return result;
}

// Computes every tile that the journal does not have; false when stopped.
bool compute_tiles(const Plan& plan, const SweepOptions& options, Engine* engine, Journal* journal,
                   Progress* progress, Assembly* assembly) {
  std::size_t number = 0;
  for (const Stage& stage : plan.stages()) {
    for (const Tile& tile : stage.tiles) {
      if (options.stop != nullptr && *options.stop) return false;
      std::optional<TileResult> result;
      if (journal != nullptr) result = journal->find(number);
      const bool resumed = result.has_value();
      if (!resumed) {
        result = compute_tile(plan, tile, assembly->initial_states(plan, tile), engine, progress);
        if (!result) return false;
        if (journal != nullptr) journal->store(number, *result);
      }
      assembly->add(tile, *result);
      progress->tile_done(tile, resumed);
      ++number;
    }
  }
  return true;
}

// The sweep, once its steps are known.
std::optional<SweepResult> run_with_steps(const Study& study,
                                          const std::optional<PilotFindings>& pilot,
                                          const SweepOptions& options) {
  const std::unique_ptr<Engine> engine = make_engine(study, options.device);
  const std::size_t tile_points = tile_size(study, *engine);
  const Plan plan(study, tile_points);
  std::optional<Journal> journal;
  if (!options.journal_path.empty()) {
    journal.emplace(options.journal_path, fingerprint(study, engine->info(), tile_points));
  }

  Progress progress(plan, options);
  Assembly assembly(study);
  if (!compute_tiles(plan, options, engine.get(), journal ? &*journal : nullptr, &progress,
                     &assembly)) {
    if (journal && journal->finished_tiles() == 0) journal->remove();
    return std::nullopt;
  }
  SweepResult result = assembly.take();
  result.engine = engine->info();
  result.pilot = pilot;
  if (options.deliver) options.deliver(result);
  if (journal) journal->remove();
  return result;
}

}  // namespace

std::optional<SweepResult> run_sweep(const Study& study, const SweepOptions& options) {
  if (study.integrate.tolerance > 0.0) {
    const std::optional<PilotRun> pilot = find_step(study, options);
    if (!pilot) return std::nullopt;
    return run_with_steps(pilot->study, pilot->findings, options);
  }
  return run_with_steps(study, std::nullopt, options);
}

}  // namespace gearsweep
