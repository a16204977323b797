#include "opencl/open_devices.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "opencl/detail/open_device.hpp"

namespace gearsweep {
namespace {

// The chosen device or part of one, and what is said of it.
cl::Device pick_device(const DeviceChoice& choice, DeviceInfo* info) {
  cl::Device whole = find_devices().at(choice.number);
  if (choice.parts == 1) return whole;
  info->compute_units /= static_cast<unsigned>(choice.parts);
  if (!info->shares_host_memory) info->memory /= static_cast<double>(choice.parts);
  const cl_device_partition_property units[] = {
      CL_DEVICE_PARTITION_EQUALLY, static_cast<cl_device_partition_property>(info->compute_units),
      0};
  std::vector<cl::Device> parts;
  whole.createSubDevices(units, &parts);
  return parts.at(choice.part);
}

}  // namespace

std::shared_ptr<OpenDevice> OpenDevices::open(const DeviceChoice& choice) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<OpenDevice>& open = open_[{choice.number, choice.part, choice.parts}];
  if (open != nullptr) return open;
  std::vector<DeviceInfo> infos = list_devices();
  if (choice.number >= infos.size()) {
    throw InputError(
        fmt::format("there is no device {}; 'gearsweep devices' lists {} (numbered "
                    "from 0)",
                    choice.number, infos.size()));
  }
  DeviceInfo& info = infos[choice.number];
  try {
    const cl::Device device = pick_device(choice, &info);
    open = std::make_shared<OpenDevice>(device, info, compile_watch_);
  } catch (const cl::Error& error) {
    throw RunError(describe_error(fmt::format("preparing device '{}'", info.name), error));
  }
  return open;
}

}  // namespace gearsweep
