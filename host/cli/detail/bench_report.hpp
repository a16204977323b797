// What the benchmarks of one or more devices found, as a table and as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "measure/benchmarks.hpp"
#include "measure/machine.hpp"
#include "opencl/device.hpp"

namespace gearsweep {

struct BenchedDevice {
  std::size_t number = 0;  // of list_devices()
  DeviceInfo info;
  std::vector<BenchmarkRow> rows;
};

// A row for each benchmark; the devices side by side, what they are above, how their kernels were
// built below.
std::string bench_table(const Machine& machine, const std::vector<BenchedDevice>& devices);

// In the format of Google Benchmark, which its tools read. Times are those of an iteration (of
// Item::per_iteration items), so that they do not depend on how much was measured. Of several
// devices, a name begins with "device:N/". date: ISO 8601.
nlohmann::json bench_json(const Machine& machine, const std::vector<BenchedDevice>& devices,
                          const std::string& date);

}  // namespace gearsweep
