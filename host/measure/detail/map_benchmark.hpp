// A whole map, computed in this process.
#pragma once

#include <string>

#include "measure/benchmarks.hpp"

namespace gearsweep {

// The built-in study coarse-map on 160 x 120 points, with steps of a given length, so that the work
// is the same everywhere. precision, stop: of integrate. Figures: "steps/s", "kernel_share" (of the
// time, that in kernels).
PreparedBenchmark prepare_map(const BenchmarkSetting& setting, const std::string& precision,
                              const std::string& stop);

}  // namespace gearsweep
