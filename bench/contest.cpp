#include "contest.hpp"

#include "figures.hpp"
#include "measure/flop_count.hpp"
#include "opencl/device.hpp"

namespace gearsweep::bench {
namespace {

// Enough points for many cores, and for some 50 ms on few.
constexpr std::size_t kScalarShare = 16, kScalarPeriods = 16;
constexpr std::size_t kSimdShare = 1, kSimdPeriods = 8;

std::size_t device_in_use() { return default_device(list_devices()); }

}  // namespace

Contest::Contest(const Case& what)
    : kernel_(what.overrides, what.settling, device_in_use()),
      peak_(device_in_use(), kernel_.study().integrate.fp64) {
  if (what.one_lane) {
    std::vector<std::string> overrides = what.overrides;
    overrides.push_back("integrate.lanes=1");
    one_lane_ = std::make_unique<KernelRun>(overrides, what.settling, device_in_use());
  }
  if (!what.states_overrides.empty()) {
    states_ = std::make_unique<KernelRun>(what.states_overrides, what.settling, device_in_use());
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
  Figures figures;
  for ([[maybe_unused]] auto turn : state) {
    const double before = peak_.launch().rate();
    const KernelRun::Rounds rounds = kernel_.run();
    const double peak = 0.5 * (before + peak_.launch().rate());
    const double rate = rounds.rate();
    state.SetIterationTime(rounds.seconds);
    const auto compare = [&](const std::string& name, double other) {
      figures.add(name + "_steps/s", other);
      figures.add("vs_" + name, rate / other);
    };
    figures.add("steps/s", rate);
    figures.add("flops_per_step", flops);
    figures.add("flop/s", rate * flops);
    figures.add("peak_flop/s", peak);
    figures.add("peak_share", rate * flops / peak);
    if (one_lane_ != nullptr) compare("one_lane", one_lane_->run().rate());
    if (states_ != nullptr) figures.add("times_states", states_->run().rate() / rate);
    for (const Rival& rival : rivals_) {
      compare(rival.name, rival.sweep->steps_per_second(rival.periods));
    }
  }
  figures.report(state);
}

}  // namespace gearsweep::bench
