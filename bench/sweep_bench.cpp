// Speed of whole sweeps, and of the host's own part of one: planning and assembling.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "plan/plan.hpp"
#include "sweep/assembly.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::bench {
namespace {

constexpr const char* kStudy = R"(
[model]
name = "gear5"
preset = "coarse"
[[axes]]
name = "omega"
from = 0.4
to = 2.0
count = 64
[[axes]]
name = "b"
from = 0.3
to = 1.5
count = 48
[integrate]
settle = 40
record = 20
[observe]
quantities = ["x1_rms", "x1_max", "dmf_max", "contact_class", "poincare"]
)";
constexpr std::size_t kTilePoints = 1024;

Study map_study() { return read_study(kStudy, "sweep_bench"); }

// Points per second, with everything from the study to the maps.
void report_points(benchmark::State& state, std::size_t points) {
  const double done = static_cast<double>(state.iterations()) * static_cast<double>(points);
  state.counters["points/s"] = benchmark::Counter(done, benchmark::Counter::kIsRate);
}

void sweep(benchmark::State& state) {
  const Study study = map_study();
  run_sweep(study, {});  // PoCL keeps what it has compiled
  double steps = 0.0;
  double inside = 0.0;
  for ([[maybe_unused]] auto turn : state) {
    const std::optional<SweepResult> result = run_sweep(study, {});
    steps += result->steps;
    inside += result->seconds;
  }
  report_points(state, study.points());
  state.counters["steps/s"] = benchmark::Counter(steps, benchmark::Counter::kIsRate);
  // The rest is the building of the kernels and the plan.
  state.counters["computing_s"] = benchmark::Counter(inside, benchmark::Counter::kAvgIterations);
}
BENCHMARK(sweep)->UseRealTime()->Unit(benchmark::kMillisecond);

void read(benchmark::State& state) {
  for ([[maybe_unused]] auto turn : state) benchmark::DoNotOptimize(map_study());
}
BENCHMARK(read)->Unit(benchmark::kMicrosecond);

void plan(benchmark::State& state) {
  const Study study = map_study();
  for ([[maybe_unused]] auto turn : state) {
    const Plan made(study, kTilePoints);
    benchmark::DoNotOptimize(made.total_work());
  }
  report_points(state, study.points());
}
BENCHMARK(plan)->Unit(benchmark::kMicrosecond);

// The phase grids of each tile, as an engine asks for them.
void phase_grids(benchmark::State& state) {
  const Plan made(map_study(), kTilePoints);
  for ([[maybe_unused]] auto turn : state) {
    for (const Tile& tile : made.stages().front().tiles) {
      for (const std::size_t start : tile.grid_starts) {
        benchmark::DoNotOptimize(made.phase_grid_of(tile.points[start]));
      }
    }
  }
  report_points(state, made.study().points());
}
BENCHMARK(phase_grids)->Unit(benchmark::kMicrosecond);

void assembly(benchmark::State& state) {
  const Study study = map_study();
  const Plan made(study, kTilePoints);
  for ([[maybe_unused]] auto turn : state) {
    Assembly maps(study, study.model->states.size());
    for (const Tile& tile : made.stages().front().tiles) {
      const std::size_t points = tile.points.size();
      TileResult answers;
      answers.status.resize(points);
      answers.outputs.resize(points * study.selection.output_count());
      answers.samples.resize(points * study.selection.poincare.size() * study.integrate.record);
      answers.final_states = maps.initial_states(made, tile);
      maps.add(made, tile, answers);
    }
    benchmark::DoNotOptimize(maps.take());
  }
  report_points(state, study.points());
}
BENCHMARK(assembly)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace gearsweep::bench
