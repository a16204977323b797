// Which device computes.
#pragma once

#include <cstddef>

namespace gearsweep {

// A device of list_devices() (opencl/device.hpp), or an equal part of its compute units.
struct DeviceChoice {
  std::size_t number = 0;
  std::size_t part = 0, parts = 1;
};

}  // namespace gearsweep
