// Kernels alone, and the peak that they stand beside.
#pragma once

#include <string>
#include <vector>

#include "measure/benchmarks.hpp"

namespace gearsweep {

// Fused multiply-adds, of which each is two operations.
PreparedBenchmark prepare_peak(const BenchmarkSetting& setting, bool fp64);

// Measures the study of KernelRun. Figures: "flop/s", "peak_share" (of the peak, mean of
// before and after).
PreparedBenchmark prepare_kernel(const BenchmarkSetting& setting, bool settling,
                                 const std::vector<std::string>& overrides);

}  // namespace gearsweep
