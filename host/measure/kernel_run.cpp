#include "measure/kernel_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "measure/machine.hpp"
#include "opencl/opencl_engine.hpp"

namespace gearsweep {
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
count = 64
[integrate]
settle = 24
record = 1
round = 4
[observe]
quantities = ["x1_max"]
)";

// Values of the second axis: 512 points for each core, and as many for a GPU's unit as a tile has.
std::size_t values_for(std::size_t device) {
  constexpr std::size_t kMin = 64, kOfCore = 8, kOfGpuUnit = 64;
  const DeviceInfo info = list_devices().at(device);
  return std::max(kMin, info.compute_units * (info.is_cpu ? kOfCore : kOfGpuUnit));
}

Study study_of(std::vector<std::string> overrides, std::size_t device) {
  overrides.push_back(fmt::format("axes.b.count={}", values_for(device)));
  return read_study(kStudy, "kernel_run", overrides);
}

}  // namespace

KernelRun::KernelRun(const std::vector<std::string>& overrides, bool settling, std::size_t device)
    : study_(study_of(overrides, device)),
      plan_(study_, study_.points()),
      settling_(settling),
      engine_(make_opencl_engine(study_, DeviceChoice{device})) {
  for (const std::size_t point : tile().points) {
    const std::vector<double> state = plan_.own_initial_state(point);
    initial_.insert(initial_.end(), state.begin(), state.end());
  }
  run();  // the first launch finishes the build
}

KernelRun::Rounds KernelRun::run() {
  return pass([](const Rounds&) { return true; });
}

KernelRun::Rounds KernelRun::run_for(double seconds, const std::atomic<bool>& stop) {
  Rounds all;
  do {
    const Rounds more = pass([&](const Rounds& rounds) {
      return !stop && (rounds.steps == 0.0 || all.seconds + rounds.seconds < seconds);
    });
    all.steps += more.steps;
    all.seconds += more.seconds;
    all.core_seconds += more.core_seconds;
  } while (!stop && all.seconds < seconds);
  return all;
}

KernelRun::Rounds KernelRun::pass(const GoesOn& goes_on) {
  const Integrate& integrate = study_.integrate;
  const std::size_t periods = settling_ ? integrate.settle : integrate.record;
  const std::size_t last = periods / integrate.round;
  std::size_t round = 0;
  Rounds rounds;
  double used = 0.0;
  std::chrono::steady_clock::time_point start;
  engine_->compute(plan_, tile(), initial_, own_window(study_), [&](double steps) {
    const auto now = std::chrono::steady_clock::now();
    ++round;
    if (round == 1) {
      start = now;
      used = core_seconds();
    } else if (round <= last) {
      rounds.steps += steps;
      rounds.seconds = std::chrono::duration<double>(now - start).count();
      rounds.core_seconds = core_seconds() - used;
    }
    return goes_on(rounds);
  });
  return rounds;
}

}  // namespace gearsweep
