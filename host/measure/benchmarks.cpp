#include "measure/benchmarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "measure/detail/kernel_benchmark.hpp"
#include "measure/detail/map_benchmark.hpp"
#include "measure/detail/start_benchmark.hpp"

namespace gearsweep {
namespace {

const char* name_of(bool fp64) { return fp64 ? "fp64" : "fp32"; }

std::vector<std::string> recorded(const std::string& quantities) {
  return {"integrate.settle=0", "integrate.record=12",
          fmt::format("observe.quantities=[{}]", quantities)};
}

// The peak and the kernels in one precision.
void add_kernels(const DeviceInfo& device, const BenchmarkSetting& setting, bool fp64,
                 std::vector<Benchmark>* benchmarks) {
  const auto add = [&](const std::string& what, const std::string& rest, const Item& item,
                       const std::function<PreparedBenchmark()>& prepare) {
    const bool is_able = !fp64 || device.fp64;
    benchmarks->push_back({fmt::format("{}/{}{}", what, name_of(fp64), rest), item,
                           is_able ? "" : "the device has no fp64", prepare});
  };
  const auto add_kernel = [&](const std::string& what, const std::string& rest,
                              std::vector<std::string> overrides) {
    overrides.push_back(fmt::format("integrate.precision={}", name_of(fp64)));
    add(what, rest, {"step", "steps/s", 1e6},
        [=] { return prepare_kernel(setting, what == "settle", overrides); });
  };
  add("fma", "", {"operation", "FLOP/s", 1e9}, [=] { return prepare_peak(setting, fp64); });
  add_kernel("settle", "", {});
  for (const std::size_t lanes : lanes_to_try(device, fp64)) {
    if (lanes == (fp64 ? device.lanes_fp64 : device.lanes_fp32)) continue;
    add_kernel("settle", fmt::format("/lanes:{}", lanes),
               {fmt::format("integrate.lanes={}", lanes)});
  }
  add_kernel("record", "/six_maps",
             recorded(R"("x1_min", "x1_max", "x1_mean", "x1_rms", "x1_std", "dmf_max")"));
  add_kernel("record", "/lyapunov_max", recorded(R"("lyapunov_max")"));
  add_kernel("record", "/lyapunov_spectrum", recorded(R"("lyapunov_spectrum")"));
}

}  // namespace

std::set<std::size_t> lanes_to_try(const DeviceInfo& device, bool fp64) {
  constexpr std::size_t kMaxLanes = 16;
  const std::size_t native = fp64 ? device.lanes_fp64 : device.lanes_fp32;
  return {1, native, std::min(2 * native, kMaxLanes)};
}

std::vector<Benchmark> benchmarks_of(const DeviceInfo& device, const BenchmarkSetting& setting) {
  std::vector<Benchmark> benchmarks;
  for (const bool fp64 : {true, false}) add_kernels(device, setting, fp64, &benchmarks);
  const std::string precision = name_of(device.fp64);
  const Item point = {"point", "points/s", 1e3};
  for (const std::string stop : {"orbit", "never"}) {
    benchmarks.push_back({fmt::format("map/{}/stop:{}", precision, stop), point, "",
                          [=] { return prepare_map(setting, precision, stop); }});
  }
  const Item start = {"start", "starts/s", 1};
  const auto folder = std::make_shared<KernelFolder>();
  for (const bool is_cold : {true, false}) {
    benchmarks.push_back({is_cold ? "start/cold" : "start/warm", start, "",
                          [=] { return prepare_start(setting, precision, is_cold, folder); }});
  }
  return benchmarks;
}

std::vector<double> BenchmarkRow::rates() const {
  std::vector<double> rates;
  for (const Repetition& one : repetitions) rates.push_back(one.items / one.seconds);
  return rates;
}

std::vector<double> BenchmarkRow::figures(const std::string& figure) const {
  std::vector<double> values;
  for (const Repetition& one : repetitions) {
    const auto found = one.figures.find(figure);
    if (found != one.figures.end()) values.push_back(found->second);
  }
  return values;
}

BenchmarkRow carry_out(const Benchmark& benchmark, std::size_t repetitions, double max_seconds,
                       const std::atomic<bool>& stop) {
  BenchmarkRow measured;
  measured.name = benchmark.name;
  measured.item = benchmark.item;
  measured.reason = benchmark.obstacle;
  if (!benchmark.obstacle.empty()) return measured;
  try {
    const PreparedBenchmark prepared = benchmark.prepare();
    measured.build_options = prepared.build_options;
    double spent = 0.0;
    while (!stop && measured.repetitions.size() < repetitions && spent < max_seconds) {
      measured.repetitions.push_back(prepared.repeat());
      spent += measured.repetitions.back().seconds;
    }
  } catch (const std::exception& error) {
    measured.repetitions.clear();
    measured.reason = error.what();
    measured.failed = true;
  }
  return measured;
}

}  // namespace gearsweep
