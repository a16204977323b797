#include "opencl/device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <mutex>

#include "model/error.hpp"
#include "model/names.hpp"
#include "model/parse_number.hpp"
#include "opencl/detail/cl.hpp"
#include "opencl/pocl_cache.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxLanes = 16;  // the widest vector of OpenCL C

// OpenCL strings may carry a terminating zero.
std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
  return text;
}

// What GEARSWEEP_LANES says, for a CPU whose driver knows its vectors wrong, or to try another
// machine's; 0 where it says nothing.
std::size_t lanes_asked_for() {
  const char* value = std::getenv("GEARSWEEP_LANES");
  if (value == nullptr || *value == '\0') return 0;
  const auto lanes = parse_number<std::size_t>(value);
  if (!lanes || std::popcount(*lanes) != 1 || *lanes > kMaxLanes) {
    throw InputError(
        fmt::format("GEARSWEEP_LANES = '{}': it must be 1, 2, 4, 8 or {}", value, kMaxLanes));
  }
  return *lanes;
}

DeviceInfo describe(const cl::Device& device) {
  DeviceInfo info;
  info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  info.platform =
      trimmed(cl::Platform(device.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_NAME>());
  info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  info.is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
  info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  info.fp64 = device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
  info.rounds_fp32_division =
      (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  info.memory = static_cast<double>(device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>());
  info.largest_buffer = static_cast<double>(device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>());
  info.shares_host_memory = info.is_cpu || device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() != 0;
  if (info.is_cpu) {
    const std::size_t asked = lanes_asked_for();
    const auto lanes = [asked](cl_uint width) {
      return asked > 0 ? asked : std::clamp<std::size_t>(width, 1, kMaxLanes);
    };
    info.lanes_fp64 = lanes(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_DOUBLE>());
    info.lanes_fp32 = lanes(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  }
  return info;
}

// What in the environment may keep the devices of an installed driver away.
std::string describe_obstacles() {
  std::string text;
  if (const std::filesystem::path folder = pocl_cache_folder(); !can_write_in(folder)) {
    text += fmt::format(
        "\n  PoCL has none where it cannot keep what it compiles, and '{}' cannot be written: set "
        "POCL_CACHE_DIR, or HOME, to a folder that can",
        folder.string());
  }
  if (const char* devices = std::getenv("POCL_DEVICES")) {
    text += fmt::format("\n  POCL_DEVICES = '{}' says which ones PoCL has: unset it", devices);
  }
  if (const char* drivers = std::getenv("OCL_ICD_VENDORS")) {
    text += fmt::format("\n  OCL_ICD_VENDORS = '{}' says where drivers are: unset it", drivers);
  }
  return text.empty() ? "" : "\nif one is installed, this may keep it away:" + text;
}

[[noreturn]] void refuse_list(const std::string& text) {
  throw InputError(
      fmt::format("--device: '{}' is no list of numbers of 'gearsweep devices', such as 0 or 0,1, "
                  "nor '0/2' for the halves of device 0, nor 'all'",
                  text));
}

// A number of at most six digits.
std::size_t number_of(const std::string& digits, const std::string& list) {
  if (digits.empty() || digits.size() > 6 ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    refuse_list(list);
  }
  return std::stoul(digits);
}

// "2" or "0/4".
DeviceChoice parse_choice(const std::string& item, const std::string& list) {
  const std::size_t slash = item.find('/');
  DeviceChoice choice;
  choice.number = number_of(item.substr(0, slash), list);
  if (slash != std::string::npos) choice.parts = number_of(item.substr(slash + 1), list);
  return choice;
}

}  // namespace

std::string describe_code(cl_int code) {
  const auto name = [code]() -> const char* {
    switch (code) {
      case CL_DEVICE_NOT_FOUND:
        return "CL_DEVICE_NOT_FOUND";
      case CL_DEVICE_NOT_AVAILABLE:
        return "CL_DEVICE_NOT_AVAILABLE";
      case CL_COMPILER_NOT_AVAILABLE:
        return "CL_COMPILER_NOT_AVAILABLE";
      case CL_MEM_OBJECT_ALLOCATION_FAILURE:
        return "CL_MEM_OBJECT_ALLOCATION_FAILURE";
      case CL_OUT_OF_RESOURCES:
        return "CL_OUT_OF_RESOURCES";
      case CL_OUT_OF_HOST_MEMORY:
        return "CL_OUT_OF_HOST_MEMORY";
      case CL_BUILD_PROGRAM_FAILURE:
        return "CL_BUILD_PROGRAM_FAILURE";
      case CL_INVALID_VALUE:
        return "CL_INVALID_VALUE";
      case CL_INVALID_BUFFER_SIZE:
        return "CL_INVALID_BUFFER_SIZE";
      case CL_INVALID_KERNEL_ARGS:
        return "CL_INVALID_KERNEL_ARGS";
      case CL_INVALID_ARG_SIZE:
        return "CL_INVALID_ARG_SIZE";
      case CL_INVALID_WORK_GROUP_SIZE:
        return "CL_INVALID_WORK_GROUP_SIZE";
      case CL_INVALID_COMMAND_QUEUE:
        return "CL_INVALID_COMMAND_QUEUE";
      case -1001:
        return "CL_PLATFORM_NOT_FOUND_KHR";
      default:
        return "OpenCL error";
    }
  };
  return fmt::format("{}, {}", name(), code);
}

std::string describe_error(const std::string& doing, const cl::Error& error) {
  return fmt::format("{} failed: {} ({})", doing, error.what(), describe_code(error.err()));
}

std::vector<cl::Device> find_devices() {
  // The first question makes PoCL 3.1 prepare its devices. Another thread that asks meanwhile is
  // told that there are none, or crashes. A driver is one for the whole process, and so is the
  // lock.
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  std::vector<cl::Device> devices;
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {
    return devices;  // the loader reports "no platform" as an error
  }
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> found;
    try {
      platform.getDevices(CL_DEVICE_TYPE_CPU | CL_DEVICE_TYPE_GPU, &found);
    } catch (const cl::Error&) {
      continue;  // a platform without devices must not hide the others
    }
    devices.insert(devices.end(), found.begin(), found.end());
  }
  return devices;
}

std::vector<DeviceInfo> list_devices() {
  try {
    std::vector<DeviceInfo> infos;
    for (const cl::Device& device : find_devices()) infos.push_back(describe(device));
    return infos;
  } catch (const cl::Error& error) {
    throw RunError(describe_error("asking for the OpenCL devices", error));
  }
}

std::vector<DeviceChoice> parse_devices(const std::string& text,
                                        const std::vector<DeviceInfo>& devices) {
  default_device(devices);  // throws when there is none
  std::vector<DeviceChoice> choices;
  if (text == "all") {
    for (std::size_t i = 0; i < devices.size(); ++i) choices.push_back({i});
    return choices;
  }
  for (const std::string& item : split(text, ',')) choices.push_back(parse_choice(item, text));
  if (choices.empty()) refuse_list(text);
  std::vector<DeviceChoice> parts;
  for (const DeviceChoice& choice : choices) {
    if (choice.number >= devices.size()) {
      throw InputError(fmt::format(
          "--device {}: there is no device {}; 'gearsweep devices' lists {} (numbered from 0)",
          text, choice.number, devices.size()));
    }
    const unsigned units = devices[choice.number].compute_units;
    if (choice.parts == 0 || choice.parts > units) {
      throw InputError(fmt::format(
          "--device {}: device {} has {} compute units, so it can be cut into 1 to {} parts", text,
          choice.number, units, units));
    }
    for (std::size_t part = 0; part < choice.parts; ++part) {
      parts.push_back({choice.number, part, choice.parts});
    }
  }
  return parts;
}

std::size_t default_device(const std::vector<DeviceInfo>& devices) {
  if (devices.empty()) {
    throw InputError(
        "no OpenCL device was found; install a driver (on Debian, pocl-opencl-icd runs on any CPU; "
        "beside a wheel, without root, gearsweep-pocl), or use integrate.engine = \"reference\"" +
        describe_obstacles());
  }
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].is_cpu) return i;
  }
  return 0;
}

}  // namespace gearsweep
