// A device, its context, and the programs that were built for it.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <tuple>
#include <utility>

#include "opencl/busy_clock.hpp"
#include "opencl/compile_watch.hpp"
#include "opencl/detail/cl.hpp"
#include "opencl/device.hpp"

namespace gearsweep {

// Engines may use it from threads of their own.
class OpenDevice {
 public:
  // compile_watch: what all devices that are opened together share.
  OpenDevice(const cl::Device& device, DeviceInfo info,
             std::shared_ptr<CompileWatch> compile_watch);

  const DeviceInfo& info() const { return info_; }
  const cl::Device& device() const { return device_; }
  const cl::Context& context() const { return context_; }
  // Counts the launches of all its engines.
  BusyClock& clock() { return clock_; }
  // Built at the first call. Throws RunError.
  cl::Program program(const std::string& source, const std::string& options);

  // Calls launch(width), which runs so many work-items of the kernel to their end: `items`, rounded
  // up to a multiple of the local size and perhaps more, which have nothing to do.
  //
  // Any number of launches run at once, but on a CPU one that is wider than all before it runs
  // alone: PoCL 3.1 compiles or loads a kernel anew for a wider launch, and counts as user of the
  // new one whoever still runs the old one. It aborts when both have ended. It has equal kernels
  // once in a process, also those of devices that were opened apart.
  //
  // Before such a launch it calls load(width), which is to launch the kernel without work: a driver
  // may compile it then, which is no time in kernels.
  template <class Load, class Launch>
  void run(const cl::Kernel& kernel, std::size_t local_size, std::size_t items, const Load& load,
           const Launch& launch) {
    const Launched key = {kernel.getInfo<CL_KERNEL_PROGRAM>()(),
                          kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(), local_size};
    const std::size_t width = (items + local_size - 1) / local_size * local_size;
    if (std::shared_lock others(launches()); !info_.is_cpu || width <= widest(key)) {
      return launch(width);
    }
    const std::lock_guard alone(launches());
    // Few launches are to run alone.
    const std::size_t wider = local_size * std::bit_ceil(width / local_size);
    {
      const CompileWatch::Work compiling(compile_watch_.get());
      load(wider);
    }
    launch(wider);
    const std::lock_guard lock(mutex_);
    widest_[key] = std::max(widest_[key], wider);
  }

 private:
  // Held by all that run in the process.
  static std::shared_mutex& launches();

  using Launched = std::tuple<cl_program, std::string, std::size_t>;
  std::size_t widest(const Launched& key) {
    const std::lock_guard lock(mutex_);
    return widest_[key];
  }

  const DeviceInfo info_;
  const cl::Device device_;
  const cl::Context context_;
  BusyClock clock_;
  const std::shared_ptr<CompileWatch> compile_watch_;
  std::mutex mutex_;
  std::map<Launched, std::size_t> widest_;
  std::map<std::pair<std::string, std::string>, cl::Program> programs_;  // by source and options
};

}  // namespace gearsweep
