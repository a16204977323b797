#include "measure/machine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace gearsweep {
namespace {

constexpr const char* kClock = "/sys/devices/system/cpu/cpu0/cpufreq/";

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

// The first "cpu MHz" of /proc/cpuinfo.
double current_mhz() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    if (line.starts_with("cpu MHz") && colon != std::string::npos) {
      return std::strtod(line.c_str() + colon + 1, nullptr);
    }
  }
  return 0.0;
}

double mhz_per_core() {
  double khz = 0.0;
  std::ifstream in(std::string(kClock) + "cpuinfo_max_freq");
  return in >> khz ? 1e-3 * khz : current_mhz();
}

bool scales_clock() {
  std::string governor;
  std::ifstream in(std::string(kClock) + "scaling_governor");
  return in >> governor && governor != "performance";
}

}  // namespace

Machine this_machine() {
  Machine machine;
  machine.host_name = host_name();
  machine.cores = std::max(1U, std::thread::hardware_concurrency());
  machine.mhz_per_core = mhz_per_core();
  machine.scales_clock = scales_clock();
  if (getloadavg(&machine.load, 1) != 1) machine.load = 0.0;
  return machine;
}

double core_seconds() {
  const auto seconds_of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
}

}  // namespace gearsweep
