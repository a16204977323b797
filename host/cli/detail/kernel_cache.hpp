// Lets PoCL work where it cannot keep compiled kernels.
#pragma once

#include <optional>

#include "result/output_file.hpp"

namespace gearsweep {

// Where files cannot be written in the folder that PoCL would take from HOME or XDG_CACHE_HOME, it
// is told to take a temporary one, which lasts as long as this. Silently no help where there can be
// no temporary folder either, or where POCL_CACHE_DIR names one.
class KernelCache {
 public:
  // Sets POCL_CACHE_DIR: before other threads start, and before OpenCL is asked for anything.
  KernelCache();
  void remove() { folder_.reset(); }

 private:
  std::optional<TemporaryFolder> folder_;
};

}  // namespace gearsweep
