#include "distribute/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <set>

#include "distribute/assembly.hpp"
#include "distribute/cluster_crew.hpp"
#include "distribute/local_crew.hpp"
#include "distribute/pilot.hpp"
#include "distribute/preparation.hpp"
#include "distribute/progress.hpp"
#include "journal/journal.hpp"
#include "model/error.hpp"
#include "model/version.hpp"

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

// What two runs must have in common for one to continue the other's journal.
Identity identity_of(const Study& study, const EngineInfo& engine, bool strict_device) {
  Identity identity = {{"study", study.toml},
                       {"kernels and formulas", source_hash()},
                       {"step", fmt::format("{}", study.integrate.max_step)}};
  if (strict_device) {
    identity.emplace_back("device", engine.device);
    identity.emplace_back("driver", engine.driver);
    identity.emplace_back("build options", engine.macros);
  }
  return identity;
}

// Computes every tile that the journal does not have.
class TileLoop {
 public:
  TileLoop(const Plan& plan, const SweepOptions& options, Crew* crew, Journal* journal,
           Assembly* assembly)
      : plan_(plan),
        options_(options),
        tiles_(tiles_of(plan)),
        crew_(crew),
        journal_(journal),
        assembly_(assembly),
        progress_(plan, options) {}

  // False when stopped.
  bool run() {
    std::size_t first = 0;
    for (const Stage& stage : plan_.stages()) {
      take_from_journal(first, stage.tiles.size());
      while (!waiting_.empty() || running_ > 0) {
        stop_if_asked();
        start_tiles();
        if (running_ == 0) break;
        if (std::optional<CrewReport> report = crew_->wait(std::chrono::milliseconds(100))) {
          handle(std::move(*report));
        }
      }
      if (is_stopping_) return false;
      if (!waiting_.empty()) std::rethrow_exception(failure_);
      first += stage.tiles.size();
    }
    return true;
  }

 private:
  void take_from_journal(std::size_t first, std::size_t count) {
    for (std::size_t number = first; number < first + count; ++number) {
      std::optional<TileResult> result;
      if (journal_ != nullptr) result = journal_->find(number);
      if (result) {
        add(number, *result, true);
      } else {
        waiting_.push_back(number);
      }
    }
  }

  void stop_if_asked() {
    if (is_stopping_ || options_.stop == nullptr || !*options_.stop) return;
    is_stopping_ = true;
    crew_->stop();
    waiting_.clear();
  }

  void start_tiles() {
    while (!waiting_.empty() && crew_->idle() > 0) {
      const std::size_t number = waiting_.front();
      waiting_.pop_front();
      progress_.begin_tile(number, *tiles_[number]);
      std::vector<double> initial;
      if (plan_.study().is_chained()) initial = assembly_->initial_states(plan_, *tiles_[number]);
      crew_->start(number, std::move(initial));
      ++running_;
    }
  }

  void handle(CrewReport report) {
    switch (report.kind) {
      case CrewReport::Kind::progress:
        progress_.add_steps(report.tile, report.steps);
        return;
      case CrewReport::Kind::more_work:
        progress_.add_work(report.tile, report.steps);
        return;
      case CrewReport::Kind::finished:
        --running_;
        // While one thing at a time is computed, it takes all of the time.
        for (const std::size_t spent : {kSeconds, kKernelSeconds}) {
          report.result.effort[spent] /=
              static_cast<double>(std::max<std::size_t>(1, crew_->size()));
        }
        // Nobody need wait for the disk.
        if (!is_stopping_) start_tiles();
        if (journal_ != nullptr) journal_->store(report.tile, report.result);
        add(report.tile, report.result, false);
        return;
      case CrewReport::Kind::stopped:
        --running_;
        progress_.drop_tile(report.tile);
        return;
      case CrewReport::Kind::lost:
        --running_;
        hand_back(report);
        return;
    }
  }

  void hand_back(const CrewReport& report) {
    progress_.drop_tile(report.tile);
    failure_ = report.failure;
    if (!is_stopping_) waiting_.push_front(report.tile);
    if (crew_->size() == 0 || !options_.on_trouble) return;
    try {
      std::rethrow_exception(report.failure);
    } catch (const std::exception& error) {
      options_.on_trouble(fmt::format("{}\nthe others take over what it had", error.what()));
    }
  }

  void add(std::size_t number, const TileResult& result, bool resumed) {
    assembly_->add(*tiles_[number], result);
    progress_.tile_done(number, *tiles_[number], resumed);
  }

  const Plan& plan_;
  const SweepOptions& options_;
  const std::vector<const Tile*> tiles_;
  Crew* crew_;
  Journal* journal_;
  Assembly* assembly_;
  Progress progress_;
  std::deque<std::size_t> waiting_;
  std::size_t running_ = 0;
  bool is_stopping_ = false;
  std::exception_ptr failure_;  // of the member that was lost last
};

// The sweep, once its steps are known.
std::optional<SweepResult> run_with_steps(const Study& study,
                                          const std::optional<PilotFindings>& pilot,
                                          const SweepOptions& options) {
  auto [engines, plan, needs] = prepare_sweep(study, options);
  const EngineInfo info = describe(engines);
  std::optional<Journal> journal;
  if (!options.journal_path.empty()) {
    journal.emplace(options.journal_path, identity_of(study, info, options.strict_device));
    journal->keep("points", std::to_string(study.trajectories()));
    for (const auto& [name, value] : options.notes) journal->keep(name, value);
    // A run that goes on keeps the cut, whatever devices it has now.
    const std::size_t kept =
        std::stoul(journal->keep("points of a tile", std::to_string(plan->tile_points())));
    if (kept != plan->tile_points()) plan.emplace(plan_as_kept(study, kept, engines, options));
  }
  Assembly assembly(study);
  const std::unique_ptr<Crew> crew = make_crew(*plan, std::move(engines), options.cluster);
  TileLoop loop(*plan, options, crew.get(), journal ? &*journal : nullptr, &assembly);
  if (!loop.run()) {
    if (journal && journal->finished_tiles() == 0) journal->remove();
    return std::nullopt;
  }
  SweepResult result = assembly.take();
  result.engine.driver = info.driver;
  result.engine.macros = info.macros;
  result.pilot = pilot;
  if (options.deliver) options.deliver(result);
  if (journal && !options.keep_journal) journal->remove();
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
