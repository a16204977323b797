// Speed of the kernels, beside what the same device can do at most (FmaPeak) and what a native
// program does on the same equations (OdeintSweep). The machine's speed drifts, so each iteration
// measures all of them in turn, and the counters are medians over the iterations.
//
//   steps/s        integration steps of single points per second, rounds after the first only
//   flops_per_step counted on the kernel's source (see Tally in counted.hpp)
//   flop/s         steps/s x flops_per_step
//   peak_flop/s    of the FMA micro-kernel, on the same device
//   peak_share     of the two
//   odeint_steps/s Boost.odeint's runge_kutta4: native, all cores, -O3 -march=native
//   vs_odeint      steps/s / odeint_steps/s
//   classic_steps/s, vs_classic   the same with its runge_kutta4_classic
//   times_states   steps/s of recording states alone / steps/s: what tangent vectors cost
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "flop_count.hpp"
#include "fma_peak.hpp"
#include "odeint_sweep.hpp"
#include "opencl/device.hpp"
#include "opencl/opencl_engine.hpp"

namespace gearsweep::bench {
namespace {

// Both axes of the usual map, so that phase grids and their tables are those of real work.
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
count = 64
[integrate]
settle = 24
record = 1
round = 4
[observe]
quantities = ["x1_max"]
)";
constexpr std::size_t kOdeintStride = 16;  // of the points: enough for some 30 ms
constexpr std::size_t kOdeintPeriods = 16;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Rival {
  OdeintStepper stepper;
  const char* name;
};
constexpr std::array kRivals = {Rival{OdeintStepper::runge_kutta4, "odeint"},
                                Rival{OdeintStepper::runge_kutta4_classic, "classic"}};

struct Case {
  std::string name;
  std::vector<std::string> overrides;  // of kStudy
  bool settling = true;                // otherwise recording
  bool odeint = false;
  std::vector<std::string> rival_overrides = {};  // of the kernel for times_states; empty: none
};

// One kernel on the points of a study, ready to run.
class KernelRun {
 public:
  KernelRun(const std::vector<std::string>& overrides, bool settling)
      : study_(read_study(kStudy, "settle_bench", overrides)),
        plan_(study_, study_.points()),
        settling_(settling),
        engine_(make_opencl_engine(study_, std::nullopt)) {
    for (const std::size_t point : tile().points) {
      const std::vector<double> state = plan_.own_initial_state(point);
      initial_.insert(initial_.end(), state.begin(), state.end());
    }
    run();  // the first launch finishes the build
  }

  const Study& study() const { return study_; }
  const Plan& plan() const { return plan_; }
  const Tile& tile() const { return plan_.stages().front().tiles.front(); }
  bool settling() const { return settling_; }

  struct Rounds {
    double steps = 0.0, seconds = 0.0;
    double rate() const { return steps / seconds; }
  };

  // Times the launches alone: from the end of the first round of the kernel in question to the end
  // of its last one.
  Rounds run() {
    const Integrate& integrate = study_.integrate;
    const std::size_t periods = settling_ ? integrate.settle : integrate.record;
    const std::size_t last = periods / integrate.round;
    std::size_t round = 0;
    Rounds rounds;
    std::chrono::steady_clock::time_point start;
    engine_->compute(plan_, tile(), initial_, windows_of(study_).front(), [&](double steps) {
      const auto now = std::chrono::steady_clock::now();
      ++round;
      if (round == 1) start = now;
      if (round > 1 && round <= last) rounds.steps += steps;
      if (round == last) rounds.seconds = std::chrono::duration<double>(now - start).count();
      return true;
    });
    return rounds;
  }

 private:
  const Study study_;
  const Plan plan_;
  const bool settling_;
  const std::unique_ptr<Engine> engine_;
  std::vector<double> initial_;
};

// Everything that one benchmark measures, ready to run.
class Contest {
 public:
  explicit Contest(const Case& what)
      : kernel_(what.overrides, what.settling),
        peak_(default_device(list_devices()), kernel_.study().integrate.fp64) {
    if (!what.rival_overrides.empty()) {
      states_ = std::make_unique<KernelRun>(what.rival_overrides, what.settling);
    }
    if (!what.odeint) return;
    for (const Rival& rival : kRivals) {
      rivals_.push_back(std::make_unique<OdeintSweep>(kernel_.plan(), kernel_.tile(), kOdeintStride,
                                                      rival.stepper));
    }
  }

  void measure(benchmark::State& state) {
    const double flops = kernel_.settling() ? flops_per_step(kernel_.study()) : 0.0;
    std::vector<double> rates, peaks, shares, costs;
    std::array<std::vector<double>, kRivals.size()> rival_rates, ratios;
    for ([[maybe_unused]] auto turn : state) {
      peaks.push_back(peak_.flops_per_second());
      const KernelRun::Rounds rounds = kernel_.run();
      state.SetIterationTime(rounds.seconds);
      rates.push_back(rounds.rate());
      shares.push_back(rates.back() * flops / peaks.back());
      if (states_ != nullptr) costs.push_back(states_->run().rate() / rates.back());
      for (std::size_t i = 0; i < rivals_.size(); ++i) {
        rival_rates[i].push_back(rivals_[i]->steps_per_second(kOdeintPeriods));
        ratios[i].push_back(rates.back() / rival_rates[i].back());
      }
    }
    const auto counter = [](double value) {
      return benchmark::Counter(value, benchmark::Counter::kDefaults,
                                benchmark::Counter::OneK::kIs1000);
    };
    state.counters["steps/s"] = counter(median(rates));
    if (kernel_.settling()) {
      state.counters["flops_per_step"] = counter(flops);
      state.counters["flop/s"] = counter(median(rates) * flops);
      state.counters["peak_flop/s"] = counter(median(peaks));
      state.counters["peak_share"] = counter(median(shares));
    }
    if (states_ != nullptr) state.counters["times_states"] = counter(median(costs));
    for (std::size_t i = 0; i < rivals_.size(); ++i) {
      const std::string name = kRivals[i].name;
      state.counters[name + "_steps/s"] = counter(median(rival_rates[i]));
      state.counters["vs_" + name] = counter(median(ratios[i]));
    }
  }

 private:
  KernelRun kernel_;
  FmaPeak peak_;
  std::unique_ptr<KernelRun> states_;
  std::vector<std::unique_ptr<OdeintSweep>> rivals_;
};

std::vector<Case> cases() {
  const std::string everything =
      "observe.quantities=[\"x1_min\", \"x1_max\", \"x1_mean\", \"x1_rms\", \"x1_std\", "
      "\"dmf_max\", \"dmf_rms\", \"contact_drive\", \"contact_losses\", \"contact_class\", "
      "\"poincare\"]";
  const std::vector<std::string> recording = {"integrate.settle=0", "integrate.record=12",
                                              everything};
  const auto measuring = [](const std::string& quantity) {
    return std::vector<std::string>{"integrate.settle=0", "integrate.record=12",
                                    "observe.quantities=[\"" + quantity + "\"]"};
  };
  const std::vector<std::string> states_alone = measuring("x1_max");
  return {
      {"settle/fp64/constant", {}, true, true},
      {"settle/fp64/constant/lanes:1", {"integrate.lanes=1"}, true, false},
      {"settle/fp64/dynamic", {"model.backlash=dynamic"}, true, true},
      {"settle/fp64/dynamic/lanes:16",
       {"model.backlash=dynamic", "integrate.lanes=16"},
       true,
       false},
      {"settle/fp32/constant", {"integrate.precision=fp32"}, true, false},
      {"settle/fp32/dynamic", {"integrate.precision=fp32", "model.backlash=dynamic"}, true, false},
      {"record/fp64/constant", recording, false, false},
      {"record/fp64/lyapunov_max", measuring("lyapunov_max"), false, false, states_alone},
      {"record/fp64/lyapunov_spectrum", measuring("lyapunov_spectrum"), false, false, states_alone},
  };
}

// Built when it first runs, as a filter may leave it out; Google Benchmark calls `measure` again
// until it has enough iterations. A device that cannot do it (no fp64) spoils this case only.
void add_benchmark(const Case& what) {
  const auto contest = std::make_shared<std::unique_ptr<Contest>>();
  const auto run = [what, contest](benchmark::State& state) {
    try {
      if (*contest == nullptr) *contest = std::make_unique<Contest>(what);
      (*contest)->measure(state);
    } catch (const std::exception& error) {
      state.SkipWithError(error.what());
    }
  };
  benchmark::RegisterBenchmark(what.name.c_str(), run)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

const bool registered = [] {
  for (const Case& what : cases()) add_benchmark(what);
  return true;
}();

}  // namespace
}  // namespace gearsweep::bench
