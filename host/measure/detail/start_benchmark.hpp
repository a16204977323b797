// How long the program takes for next to no work.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/benchmarks.hpp"
#include "result/output_file.hpp"

namespace gearsweep {

// Where the drivers' compilers and gearsweep keep built kernels for this; made at first use.
class KernelFolder {
 public:
  // Whether a run has left its kernels there.
  bool is_filled() const { return is_filled_; }
  void set_filled() { is_filled_ = true; }
  void empty();
  // "NAME=value" for each program that would look elsewhere.
  std::vector<std::string> environment();

 private:
  std::optional<TemporaryFolder> folder_;
  bool is_filled_ = false;
};

// From the start of gearsweep to the closed file of 8 x 8 points of coarse-map. Cold: with no
// kernel built before; warm: with all of them.
PreparedBenchmark prepare_start(const BenchmarkSetting& setting, const std::string& precision,
                                bool is_cold, const std::shared_ptr<KernelFolder>& folder);

}  // namespace gearsweep
