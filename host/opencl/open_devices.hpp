// The devices that a process has opened: engines that share them start with what an earlier one has
// built, for instance those of a pilot run and of the run itself.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <tuple>

#include "engine/device_choice.hpp"
#include "opencl/compile_watch.hpp"

namespace gearsweep {

class OpenDevice;

// Its functions may be called from threads of their own.
class OpenDevices {
 public:
  // Opens the device at the first call. Throws InputError when there is none of this number, or
  // RunError when it cannot be opened or cut.
  std::shared_ptr<OpenDevice> open(const DeviceChoice& choice);
  // Watches what is compiled for any of them.
  CompileWatch& compile_watch() { return *compile_watch_; }

 private:
  const std::shared_ptr<CompileWatch> compile_watch_ = std::make_shared<CompileWatch>();
  std::mutex mutex_;
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::shared_ptr<OpenDevice>> open_;
};

}  // namespace gearsweep
