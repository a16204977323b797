#include "sweep/detail/machine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

namespace gearsweep {
namespace {

// A number that stands alone in a file; nothing for "max" or without the file.
std::optional<double> number_in(const std::string& path) {
  std::ifstream file(path);
  double number = 0.0;
  if (file >> number) return number;
  return std::nullopt;
}

// The number after a name at the beginning of a line: "MemAvailable:   123 kB".
std::optional<double> number_after(const std::string& path, const std::string& name) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    double number = 0.0;
    if (word == name && file >> number) return number;
  }
  return std::nullopt;
}

// What a limit leaves of a group's memory; pages of files that can be dropped do not count as used.
std::optional<double> left_in_group(const std::string& limit_file, const std::string& used_file,
                                    const std::string& statistics, const std::string& droppable) {
  const std::optional<double> limit = number_in(limit_file);
  const std::optional<double> used = number_in(used_file);
  if (!limit || !used) return std::nullopt;
  return *limit - *used + number_after(statistics, droppable).value_or(0.0);
}

std::string group_of_this_process() {
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("0::")) return line.substr(3);
  }
  return "/";
}

std::optional<double> left_of_address_space() {
  struct rlimit limit = {};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  const std::optional<double> pages = number_in("/proc/self/statm");
  if (!pages) return std::nullopt;
  return static_cast<double>(limit.rlim_cur) - *pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

std::optional<double> available_memory() {
  constexpr double kKilobyte = 1024.0;
  std::optional<double> min = number_after("/proc/meminfo", "MemAvailable:");
  if (min) *min *= kKilobyte;
  const std::string groups = "/sys/fs/cgroup";
  std::vector<std::optional<double>> others = {left_of_address_space()};
  for (const std::string& group : {groups, groups + group_of_this_process()}) {
    others.push_back(left_in_group(group + "/memory.max", group + "/memory.current",
                                   group + "/memory.stat", "inactive_file"));
  }
  const std::string old = groups + "/memory";
  others.push_back(left_in_group(old + "/memory.limit_in_bytes", old + "/memory.usage_in_bytes",
                                 old + "/memory.stat", "total_inactive_file"));
  for (const std::optional<double>& other : others) {
    if (other) min = std::max(0.0, min ? std::min(*min, *other) : *other);
  }
  return min;
}

std::optional<double> available_disk(const std::string& folder) {
  std::error_code error;
  const std::filesystem::space_info space =
      std::filesystem::space(folder.empty() ? "." : folder, error);
  if (error) return std::nullopt;
  return static_cast<double>(space.available);
}

}  // namespace gearsweep
