#include "measure/detail/map_benchmark.hpp"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "measure/machine.hpp"
#include "study/builtin_studies.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {
namespace {

Study map_study(const std::string& precision, const std::string& stop, std::size_t x,
                std::size_t y) {
  return read_study(
      builtin_studies().at("coarse-map.toml"), "coarse-map",
      {fmt::format("axes.omega.count={}", x), fmt::format("axes.e0.count={}", y),
       "integrate.max_step=0.2", "integrate.precision=" + precision, "integrate.stop=" + stop});
}

}  // namespace

PreparedBenchmark prepare_map(const BenchmarkSetting& setting, const std::string& precision,
                              const std::string& stop) {
  SweepOptions options;
  options.devices = {DeviceChoice{setting.device}};
  options.stop = setting.stop;
  // Builds the kernels.
  const std::optional<SweepResult> few = run_sweep(map_study(precision, stop, 8, 8), options);
  const auto study = std::make_shared<Study>(map_study(precision, stop, 160, 120));
  return {few ? few->engine.macros : "", [=] {
            const auto start = std::chrono::steady_clock::now();
            const double used = core_seconds();
            const std::optional<SweepResult> maps = run_sweep(*study, options);
            const double seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            if (!maps) return Repetition{};
            return Repetition{static_cast<double>(study->points()),
                              seconds,
                              core_seconds() - used,
                              {{"steps/s", maps->steps / seconds},
                               {"kernel_share", maps->kernel_seconds / seconds}}};
          }};
}

}  // namespace gearsweep
