#include "measure/detail/kernel_benchmark.hpp"

#include <memory>

#include "measure/flop_count.hpp"
#include "measure/kernel_run.hpp"
#include "measure/machine.hpp"
#include "opencl/fma_peak.hpp"

namespace gearsweep {

PreparedBenchmark prepare_peak(const BenchmarkSetting& setting, bool fp64) {
  const auto peak = std::make_shared<FmaPeak>(setting.device, fp64);
  return {"", [setting, peak] {
            Repetition repetition;
            const double used = core_seconds();
            while (!*setting.stop && repetition.seconds < setting.seconds) {
              const FmaPeak::Launch launch = peak->launch();
              repetition.items += launch.flops;
              repetition.seconds += launch.seconds;
            }
            repetition.core_seconds = core_seconds() - used;
            return repetition;
          }};
}

PreparedBenchmark prepare_kernel(const BenchmarkSetting& setting, bool settling,
                                 const std::vector<std::string>& overrides) {
  const auto kernel = std::make_shared<KernelRun>(overrides, settling, setting.device);
  const Study& study = kernel->study();
  const auto peak = std::make_shared<FmaPeak>(setting.device, study.integrate.fp64);
  const double flops = flops_per_step(study, settling ? 0 : study.selection.tangent_count());
  return {kernel->build_options(), [=] {
            // The clock of a machine drifts.
            const double before = peak->launch().rate();
            const KernelRun::Rounds rounds = kernel->run_for(setting.seconds, *setting.stop);
            const double at_most = 0.5 * (before + peak->launch().rate());
            const double rate = flops * rounds.rate();
            return Repetition{rounds.steps,
                              rounds.seconds,
                              rounds.core_seconds,
                              {{"flop/s", rate}, {"peak_share", rate / at_most}}};
          }};
}

}  // namespace gearsweep
