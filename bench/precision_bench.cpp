// Work against precision on periodic orbits whose teeth part: the kernel at 64 to 8192 steps per
// period, in fp64 and fp32, with and without correcting the steps in which a limit of the backlash
// is crossed, and Boost.odeint's controlled Dormand-Prince method at tolerances 1e-4 to 1e-12.
//
//   periods/s  periods of single points per second, all cores; of the fastest iteration, since what
//              else the machine does only slows
//   max_error  largest error of a section's state after kPeriods, relative to its largest
//              component, over every kStride-th point; the truth is Dormand-Prince at 1e-15
//   rms_error  root mean square of these points' errors
//
// bench/precision.gp draws .readme/precision.png from what it writes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dopri_sweep.hpp"
#include "opencl/opencl_engine.hpp"

namespace gearsweep::bench {
namespace {

// Stable periodic motions, of period 1 and 2, that lose contact in each period. Neighbours along mu
// share a work-item, as in any map.
constexpr const char* kStudy = R"(
[model]
name = "gear5"
preset = "coarse"
[[axes]]
name = "mu"
from = 0.03
to = 0.07
count = 64
[[axes]]
name = "omega"
values = [0.62, 0.64, 0.66, 0.8, 0.85, 0.9, 0.99, 1.01]
[integrate]
settle = 24
record = 1
round = 8
[observe]
quantities = ["x1_max"]
)";
constexpr std::size_t kPeriods = 25;  // settle + record
constexpr std::size_t kStride = 32;

std::vector<std::size_t> judged_points(const Plan& plan) {
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < plan.study().points(); i += kStride) points.push_back(i);
  return points;
}

const std::vector<GearState>& truth() {
  static const std::vector<GearState> states = [] {
    const Study study = read_study(kStudy, "precision_bench");
    const Plan plan(study, study.points());
    return DopriSweep(plan, judged_points(plan)).run(1e-15, kPeriods).states;
  }();
  return states;
}

struct Errors {
  double max = 0.0, rms = 0.0;
};

Errors errors_of(const std::vector<GearState>& found) {
  Errors errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    double error = 0.0;
    double scale = 0.0;
    for (std::size_t j = 0; j < found[i].size(); ++j) {
      error = std::max(error, std::abs(found[i][j] - truth()[i][j]));
      scale = std::max(scale, std::abs(truth()[i][j]));
    }
    errors.max = std::max(errors.max, error / scale);
    errors.rms += error * error / (scale * scale) / static_cast<double>(found.size());
  }
  errors.rms = std::sqrt(errors.rms);
  return errors;
}

double max_of(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

void report(benchmark::State& state, const std::vector<double>& rates, const Errors& errors) {
  state.counters["periods/s"] = max_of(rates);
  state.counters["max_error"] = errors.max;
  state.counters["rms_error"] = errors.rms;
}

// The kernel on all points of the study, ready to run.
class KernelSweep {
 public:
  explicit KernelSweep(const std::vector<std::string>& overrides)
      : study_(read_study(kStudy, "precision_bench", overrides)),
        plan_(study_, study_.points()),
        engine_(make_opencl_engine(study_, std::nullopt)) {
    for (const std::size_t point : tile().points) {
      const std::vector<double> state = plan_.own_initial_state(point);
      initial_.insert(initial_.end(), state.begin(), state.end());
    }
  }

  struct Speed {
    double periods = 0.0, seconds = 0.0;
  };

  // Times the settling rounds after the first, whose launch finishes the build.
  Speed run() {
    const std::size_t rounds = study_.integrate.settle / study_.integrate.round;
    std::size_t round = 0;
    std::chrono::steady_clock::time_point start;
    double seconds = 0.0;
    result_ = *engine_->compute(plan_, tile(), initial_, windows_of(study_).front(), [&](double) {
      const auto now = std::chrono::steady_clock::now();
      ++round;
      if (round == 1) start = now;
      if (round == rounds) seconds = std::chrono::duration<double>(now - start).count();
      return true;
    });
    const std::size_t periods = study_.integrate.settle - study_.integrate.round;
    return {static_cast<double>(periods * study_.points()), seconds};
  }

  std::vector<GearState> states() const {
    std::vector<GearState> found;
    for (const std::size_t point : judged_points(plan_)) {
      const auto& points = tile().points;
      const auto place =
          std::distance(points.begin(), std::find(points.begin(), points.end(), point));
      const auto first = result_.final_states.begin() + place * std::ptrdiff_t{10};
      found.emplace_back();
      std::copy(first, first + 10, found.back().begin());
    }
    return found;
  }

 private:
  const Tile& tile() const { return plan_.stages().front().tiles.front(); }

  const Study study_;
  const Plan plan_;
  const std::unique_ptr<Engine> engine_;
  std::vector<double> initial_;
  TileResult result_;
};

void measure_kernel(benchmark::State& state, const std::vector<std::string>& overrides) {
  try {
    KernelSweep sweep(overrides);
    std::vector<double> rates;
    for ([[maybe_unused]] auto turn : state) {
      const KernelSweep::Speed speed = sweep.run();
      state.SetIterationTime(speed.seconds);
      rates.push_back(speed.periods / speed.seconds);
    }
    report(state, rates, errors_of(sweep.states()));
  } catch (const std::exception& error) {
    state.SkipWithError(error.what());
  }
}

void measure_dopri(benchmark::State& state, double tolerance) {
  const Study study = read_study(kStudy, "precision_bench");
  const Plan plan(study, study.points());
  const std::vector<std::size_t> points = judged_points(plan);
  const DopriSweep sweep(plan, points);
  DopriSweep::Run run;
  std::vector<double> rates;
  for ([[maybe_unused]] auto turn : state) {
    run = sweep.run(tolerance, kPeriods);
    rates.push_back(static_cast<double>(points.size() * kPeriods) / run.seconds);
    state.SetIterationTime(run.seconds);
  }
  report(state, rates, errors_of(run.states));
}

const int kRegistered = [] {
  for (const std::string precision : {"fp64", "fp32"}) {
    for (const std::string events : {"true", "false"}) {
      for (std::size_t steps = 64; steps <= 8192; steps *= 2) {
        const std::string count = std::to_string(steps);
        const std::string name = "rk4/" + precision + (events == "true" ? "/events" : "/plain");
        const std::vector<std::string> overrides = {"integrate.precision=" + precision,
                                                    "integrate.events=" + events,
                                                    "integrate.steps_per_period=" + count};
        benchmark::RegisterBenchmark(
            (name + "/steps:" + count).c_str(),
            [overrides](benchmark::State& state) { measure_kernel(state, overrides); })
            ->UseManualTime()
            ->ComputeStatistics("fastest", max_of);
      }
    }
  }
  for (int digits = 4; digits <= 12; ++digits) {
    benchmark::RegisterBenchmark(
        ("dopri5/digits:" + std::to_string(digits)).c_str(),
        [digits](benchmark::State& state) { measure_dopri(state, std::pow(10.0, -digits)); })
        ->UseManualTime()
        ->ComputeStatistics("fastest", max_of);
  }
  return 0;
}();

}  // namespace
}  // namespace gearsweep::bench
