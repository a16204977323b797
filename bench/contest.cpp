#include "contest.hpp"

#include <algorithm>
#include <map>

#include "flop_count.hpp"
#include "opencl/device.hpp"

namespace gearsweep::bench {
namespace {

// Enough points for many cores, and for some 50 ms on few.
constexpr std::size_t kScalarShare = 16, kScalarPeriods = 16;
constexpr std::size_t kSimdShare = 1, kSimdPeriods = 8;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Contest::Contest(const Case& what)
    : kernel_(what.overrides, what.settling),
      peak_(default_device(list_devices()), kernel_.study().integrate.fp64) {
  if (what.one_lane) {
    std::vector<std::string> overrides = what.overrides;
    overrides.push_back("integrate.lanes=1");
    one_lane_ = std::make_unique<KernelRun>(overrides, what.settling);
  }
  if (!what.states_overrides.empty()) {
    states_ = std::make_unique<KernelRun>(what.states_overrides, what.settling);
  }
  if (!what.odeint) return;
  const auto add_rivals = [&](const std::string& suffix, std::size_t share, std::size_t periods,
                              OdeintNumber number) {
    const auto make = [&](OdeintStepper stepper) {
      return make_odeint_sweep(kernel_.plan(), kernel_.tile(), share, stepper, number);
    };
    rivals_.push_back({"odeint" + suffix, periods, make(OdeintStepper::runge_kutta4)});
    rivals_.push_back({"classic" + suffix, periods, make(OdeintStepper::runge_kutta4_classic)});
  };
  add_rivals("", kScalarShare, kScalarPeriods, OdeintNumber::scalar);
  add_rivals("_simd", kSimdShare, kSimdPeriods, OdeintNumber::simd);
}

void Contest::measure(benchmark::State& state) {
  const std::size_t tangents = kernel_.settling() ? 0 : kernel_.study().selection.tangent_count();
  const double flops = flops_per_step(kernel_.study(), tangents);
  std::map<std::string, std::vector<double>> found;
  for ([[maybe_unused]] auto turn : state) {
    const double peak = peak_.flops_per_second();
    const KernelRun::Rounds rounds = kernel_.run();
    const double rate = rounds.rate();
    state.SetIterationTime(rounds.seconds);
    const auto compare = [&](const std::string& name, double other) {
      found[name + "_steps/s"].push_back(other);
      found["vs_" + name].push_back(rate / other);
    };
    found["steps/s"].push_back(rate);
    found["flops_per_step"].push_back(flops);
    found["flop/s"].push_back(rate * flops);
    found["peak_flop/s"].push_back(peak);
    found["peak_share"].push_back(rate * flops / peak);
    if (one_lane_ != nullptr) compare("one_lane", one_lane_->run().rate());
    if (states_ != nullptr) found["times_states"].push_back(states_->run().rate() / rate);
    for (const Rival& rival : rivals_) {
      compare(rival.name, rival.sweep->steps_per_second(rival.periods));
    }
  }
  for (const auto& [name, values] : found) {
    state.counters[name] = benchmark::Counter(median(values), benchmark::Counter::kDefaults,
                                              benchmark::Counter::OneK::kIs1000);
  }
}

}  // namespace gearsweep::bench
