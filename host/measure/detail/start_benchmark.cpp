#include "measure/detail/start_benchmark.hpp"

#include "measure/program_run.hpp"

namespace gearsweep {

void KernelFolder::empty() {
  folder_.reset();
  is_filled_ = false;
}

std::vector<std::string> KernelFolder::environment() {
  if (!folder_) folder_.emplace();
  const std::string path = folder_->path();
  return {"POCL_CACHE_DIR=" + path, "XDG_CACHE_HOME=" + path, "CUDA_CACHE_PATH=" + path,
          "GEARSWEEP_CACHE_DIR"};
}

PreparedBenchmark prepare_start(const BenchmarkSetting& setting, const std::string& precision,
                                bool is_cold, const std::shared_ptr<KernelFolder>& folder) {
  const auto start = [=] {
    const ProgramCall call = {
        .study = "coarse-map",
        .overrides = {"axes.omega.count=8", "axes.e0.count=8", "integrate.max_step=0.2",
                      "integrate.precision=" + precision},
        .options = {"--device", std::to_string(setting.device)},
        .environment = folder->environment()};
    const ProgramCost cost = run_program(setting.program, call, setting.stop);
    folder->set_filled();
    return Repetition{1.0, cost.wall_seconds, cost.core_seconds, {}};
  };
  if (is_cold) {
    return {"", [=] {
              folder->empty();
              return start();
            }};
  }
  if (!folder->is_filled()) start();
  return {"", start};
}

}  // namespace gearsweep
