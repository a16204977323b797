// Speed of the kernels, beside what the same device can do at most and what a native program does
// on the same equations. The counters are explained at Contest (contest.hpp).
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks.hpp"
#include "contest.hpp"
#include "measure/benchmarks.hpp"
#include "opencl/device.hpp"

namespace gearsweep::bench {
namespace {

struct Observed {
  const char* name;
  const char* quantities;  // empty: the kernel that settles
};
constexpr Observed kSettle = {"settle", ""};
constexpr Observed kStates = {"x1_max", "\"x1_max\""};
constexpr Observed kMaps = {"maps",
                            "\"x1_min\", \"x1_max\", \"x1_mean\", \"x1_rms\", \"x1_std\", "
                            "\"dmf_max\", \"dmf_rms\", \"contact_drive\", \"contact_losses\", "
                            "\"contact_class\", \"poincare\""};
constexpr Observed kPeriod = {"period", "\"period\""};
constexpr Observed kLyapunovMax = {"lyapunov_max", "\"lyapunov_max\""};
constexpr Observed kSpectrum = {"lyapunov_spectrum", "\"lyapunov_spectrum\""};

constexpr const char* kPrecisions[] = {"fp64", "fp32"};
constexpr const char* kLaws[] = {"constant", "dynamic"};

std::vector<std::string> overrides_of(const std::string& precision, const std::string& law,
                                      const Observed& observed) {
  std::vector<std::string> overrides = {"integrate.precision=" + precision,
                                        "model.backlash=" + law};
  if (observed.quantities[0] != '\0') {
    overrides.insert(overrides.end(),
                     {"integrate.settle=0", "integrate.record=12",
                      fmt::format("observe.quantities=[{}]", observed.quantities)});
  }
  return overrides;
}

Case make_case(const std::string& precision, const std::string& law, const Observed& observed) {
  const bool settling = observed.quantities[0] == '\0';
  Case result;
  result.name = fmt::format("{}/{}/{}", settling ? "settle" : "record", precision, law);
  if (!settling) result.name += fmt::format("/{}", observed.name);
  result.overrides = overrides_of(precision, law, observed);
  result.settling = settling;
  return result;
}

// What doc/speed.md promises something about.
std::vector<Case> headline() {
  std::vector<Case> cases;
  for (const char* precision : kPrecisions) {
    for (const char* law : kLaws) {
      cases.push_back(make_case(precision, law, kSettle));
      cases.back().odeint = true;
      cases.back().one_lane = law == kLaws[0];
      // The method alone: odeint's steppers do not correct the steps in which teeth meet or part.
      Case plain = cases.back();
      plain.name += "/uncorrected";
      plain.overrides.emplace_back("integrate.events=false");
      cases.push_back(plain);
    }
  }
  cases.push_back(make_case("fp64", "constant", kMaps));
  for (const Observed& observed : {kLyapunovMax, kSpectrum}) {
    cases.push_back(make_case("fp64", "constant", observed));
    cases.back().states_overrides = overrides_of("fp64", "constant", kStates);
  }
  return cases;
}

// Precision x lanes x backlash law x observables.
std::vector<Case> matrix() {
  const std::vector<DeviceInfo> devices = list_devices();
  const DeviceInfo& device = devices[default_device(devices)];
  std::vector<Case> cases;
  for (const char* precision : kPrecisions) {
    for (const std::size_t lanes : lanes_to_try(device, precision == kPrecisions[0])) {
      for (const char* law : kLaws) {
        for (const Observed& observed : {kSettle, kMaps, kPeriod, kLyapunovMax, kSpectrum}) {
          Case one = make_case(precision, law, observed);
          one.name = fmt::format("matrix/{}/lanes:{}/{}/{}", precision, lanes, law, observed.name);
          one.overrides.push_back(fmt::format("integrate.lanes={}", lanes));
          cases.push_back(one);
        }
      }
    }
  }
  return cases;
}

// The contest that ran last, by the name of its case.
struct Running {
  std::string name;
  std::unique_ptr<Contest> contest;
};

// Built when it first runs, as a filter may leave it out, and let go when the next one is built;
// Google Benchmark calls `run` again until it has enough iterations. A device that cannot do it (no
// fp64) spoils this case only.
void add_case(const Case& what, bool of_five, const std::shared_ptr<Running>& running) {
  const auto run = [what, running](benchmark::State& state) {
    try {
      if (running->name != what.name) {
        *running = {};
        *running = {what.name, std::make_unique<Contest>(what)};
      }
      running->contest->measure(state);
    } catch (const std::exception& error) {
      state.SkipWithError(error.what());
    }
  };
  benchmark::internal::Benchmark* added = benchmark::RegisterBenchmark(what.name.c_str(), run);
  added->UseManualTime()->Unit(benchmark::kMillisecond);
  if (of_five) added->Iterations(5);
}

}  // namespace

void add_benchmarks(bool all) {
  const auto running = std::make_shared<Running>();
  for (const Case& what : headline()) add_case(what, all, running);
  if (!all) return;
  for (const Case& what : matrix()) add_case(what, all, running);
}

}  // namespace gearsweep::bench
