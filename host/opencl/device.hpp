// The OpenCL devices of this machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/device_choice.hpp"

namespace gearsweep {

struct DeviceInfo {
  std::string name, platform, driver;
  bool is_cpu = false;
  bool fp64 = false;
  unsigned compute_units = 0;
  std::size_t lanes_fp64 = 1, lanes_fp32 = 1;  // points per work-item that suit the device
  double memory = 0.0, largest_buffer = 0.0;   // bytes
  bool shares_host_memory = false;             // its memory is that of the machine
  bool rounds_fp32_division = false;           // correctly, when it is asked to
};

// All devices of all platforms, CPUs and GPUs; the order gives their numbers. Empty when there is
// none. Any thread may ask at any time. Throws RunError when OpenCL itself fails.
std::vector<DeviceInfo> list_devices();

// The device that a run uses when none is named: the first CPU, so that a study gives the same bits
// whether or not a GPU is there; without a CPU driver the first device. Throws InputError when
// there is none.
std::size_t default_device(const std::vector<DeviceInfo>& devices);

// "all", or a list of numbers of `devices` such as "0,2"; "0/4" stands for all four quarters of
// device 0. Throws InputError.
std::vector<DeviceChoice> parse_devices(const std::string& text,
                                        const std::vector<DeviceInfo>& devices);

}  // namespace gearsweep
