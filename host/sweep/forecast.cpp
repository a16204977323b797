#include "sweep/forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "scheduler/cluster.hpp"
#include "sweep/run_context.hpp"
#include "tile/subset.hpp"
#include "tile/tile_run.hpp"

namespace gearsweep {
namespace {

using Seconds = std::chrono::duration<double>;
constexpr Seconds kPatience(2.0);  // with one run of a sample
constexpr Seconds kEnough(1.0);    // of repetitions

// About `points` points of the study, each on its own.
Study sample_of(const Study& study, std::size_t points) {
  Study sample = study;
  sample.separate_points();
  // A short axis leaves more points to the other.
  const std::size_t root = static_cast<std::size_t>(std::sqrt(static_cast<double>(points)));
  std::vector<Axis>& axes = sample.axes;
  if (axes.size() == 1) {
    axes[0] = thin(axes[0], points);
  } else {
    const bool x_is_short = axes[0].values.size() <= axes[1].values.size();
    Axis& shorter = axes[x_is_short ? 0 : 1];
    Axis& longer = axes[x_is_short ? 1 : 0];
    shorter = thin(shorter, std::max<std::size_t>(1, root));
    longer = thin(longer, points / shorter.values.size());
  }
  return sample;
}

// How fast an engine computes the sample.
struct Pace {
  double seconds = 0.0, steps = 0.0;
  bool is_whole = false;
};

Pace measure(const Plan& plan, Engine* engine, const std::atomic<bool>* stop) {
  const Tile& tile = plan.stages().front().tiles.front();
  const std::vector<double> initial = own_initial_states(plan, tile);
  Pace pace;
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [&] { return std::chrono::steady_clock::now() - start; };
  TileCallbacks callbacks;
  callbacks.after_round = [&](double steps) {
    pace.steps += steps;
    return elapsed() < kPatience && (stop == nullptr || !*stop);
  };
  callbacks.on_work = [](double) {};
  pace.is_whole = run_tile(plan, tile, initial, engine, callbacks).has_value();
  pace.seconds = Seconds(elapsed()).count();
  return pace;
}

// Whatever else runs on the machine disturbs a short measurement: the best of some.
Pace best_pace(const Plan& plan, Engine* engine, const std::atomic<bool>* stop) {
  measure(plan, engine, stop);  // the driver compiles
  const auto start = std::chrono::steady_clock::now();
  Pace best = measure(plan, engine, stop);
  while (best.is_whole && std::chrono::steady_clock::now() - start < kEnough) {
    const Pace again = measure(plan, engine, stop);
    if (again.is_whole && again.seconds < best.seconds) best = again;
  }
  return best;
}

// Sets the time that the study will take, and what is said of the sample.
void measure_time(const RunContext& run, const SweepOptions& options, Forecast* forecast) {
  const Study& study = run.plan().study();
  double rate = 0.0;  // shares of the study per second, on all engines together
  forecast->has_whole_sample = true;
  for (const std::unique_ptr<Engine>& engine : run.engines()) {
    // Enough points that those on orbits of one length fill a launch.
    constexpr std::size_t kFillings = 16;
    const std::size_t wanted = std::min(kFillings * engine->min_tile(), run.plan().tile_points());
    const Study sample = sample_of(study, wanted);
    const Plan plan(sample, sample.points());
    const Pace pace = best_pace(plan, engine.get(), options.stop);
    forecast->sample = std::max(forecast->sample, sample.points());
    forecast->has_whole_sample = forecast->has_whole_sample && pace.is_whole;
    const double share = pace.is_whole ? static_cast<double>(sample.points()) /
                                             static_cast<double>(study.trajectories())
                                       : pace.steps / forecast->steps;
    rate += share / pace.seconds;
  }
  if (options.cluster != nullptr) rate *= options.cluster->size();
  forecast->seconds = 1.0 / rate;
}

}  // namespace

std::optional<Forecast> forecast_sweep(const Study& study, const SweepOptions& options) {
  const std::optional<SteppedStudy> stepped = choose_step(study, options);
  if (!stepped) return std::nullopt;
  RunContext run(*stepped, options);
  run.find_engines();
  run.plan_tiles();
  Forecast forecast;
  forecast.integrated = run.plan().study().model->state_names();
  forecast.states = study.model->states.size();
  forecast.study = stepped->study;
  forecast.pilot = stepped->pilot;
  forecast.estimate = run.estimate();
  forecast.points = study.points();
  forecast.trajectories = study.trajectories();
  forecast.tile_points = run.plan().tile_points();
  for (const Stage& stage : run.plan().stages()) forecast.tiles += stage.tiles.size();
  forecast.steps = run.plan().total_work();
  measure_time(run, options, &forecast);
  if (options.stop != nullptr && *options.stop) return std::nullopt;
  return forecast;
}

}  // namespace gearsweep
