#include "opencl/detail/open_device.hpp"

#include "opencl/detail/program_cache.hpp"

namespace gearsweep {

OpenDevice::OpenDevice(const cl::Device& device, DeviceInfo info,
                       std::shared_ptr<CompileWatch> compile_watch)
    : info_(std::move(info)),
      device_(device),
      context_(device),
      compile_watch_(std::move(compile_watch)) {}

std::shared_mutex& OpenDevice::launches() {
  static std::shared_mutex all;
  return all;
}

cl::Program OpenDevice::program(const std::string& source, const std::string& options) {
  const std::lock_guard lock(mutex_);
  const auto known = programs_.find({source, options});
  if (known != programs_.end()) return known->second;
  const CompileWatch::Work compiling(compile_watch_.get());
  cl::Program program =
      cached_program(context_, device_, source, options, program_cache_folder(info_.platform));
  programs_.emplace(std::pair(source, options), program);
  return program;
}

}  // namespace gearsweep
