// A device, its context, and the programs that were built for it.
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "opencl/busy_clock.hpp"
#include "opencl/detail/cl.hpp"
#include "opencl/device.hpp"

namespace gearsweep {

// Engines may use it from threads of their own.
class OpenDevice {
 public:
  OpenDevice(const cl::Device& device, DeviceInfo info);

  const DeviceInfo& info() const { return info_; }
  const cl::Device& device() const { return device_; }
  const cl::Context& context() const { return context_; }
  // Counts the launches of all its engines.
  BusyClock& clock() { return clock_; }
  // Built at the first call. Throws RunError.
  cl::Program program(const std::string& source, const std::string& options);

 private:
  const DeviceInfo info_;
  const cl::Device device_;
  const cl::Context context_;
  BusyClock clock_;
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, cl::Program> programs_;  // by source and options
};

}  // namespace gearsweep
