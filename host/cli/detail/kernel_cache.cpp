#include "cli/detail/kernel_cache.hpp"

#include <cstdlib>

#include "model/error.hpp"
#include "opencl/pocl_cache.hpp"

namespace gearsweep {

KernelCache::KernelCache() {
  constexpr const char* kName = "POCL_CACHE_DIR";
  if (std::getenv(kName) != nullptr || can_write_in(pocl_cache_folder())) return;
  try {
    folder_.emplace();
    setenv(kName, folder_->path().c_str(), 1);
  } catch (const RunError&) {
    // The message that no device was found says what to do.
  }
}

}  // namespace gearsweep
