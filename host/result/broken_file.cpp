#include "result/broken_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>

#include "model/error.hpp"
#include "model/regular_file.hpp"
#include "result/detail/netcdf_file.hpp"
#include "result/pipe.hpp"
#include "result/result_file.hpp"

namespace gearsweep {
namespace {

constexpr char kSound = 's';

void read_attributes(const NetcdfFile& file, int variable) {
  int count = 0;
  file.check(nc_inq_varnatts(file.id(), variable, &count), "count the attributes");
  for (int i = 0; i < count; ++i) {
    std::array<char, NC_MAX_NAME + 1> name{};
    file.check(nc_inq_attname(file.id(), variable, i, name.data()), "read an attribute's name");
    file.text_attribute(variable, name.data());
    file.number_attribute(variable, name.data());
  }
}

// In blocks along the first dimension, so that a map of many samples need not fit into memory.
void read_values(const NetcdfFile& file, int variable) {
  constexpr std::size_t kMaxNumbers = std::size_t{1} << 22U;
  std::vector<std::size_t> start, count;
  std::size_t row = 1;
  for (const int dimension : file.dimensions_of(variable)) {
    start.push_back(0);
    count.push_back(file.dimension_size(dimension));
    if (count.size() > 1) row *= std::max<std::size_t>(1, count.back());
  }
  if (count.empty()) {
    file.read(variable, start, count);
    return;
  }
  const std::size_t end = count.front();
  const std::size_t rows = std::max<std::size_t>(1, kMaxNumbers / row);
  for (start[0] = 0; start[0] < end; start[0] += rows) {
    count[0] = std::min(rows, end - start[0]);
    file.read(variable, start, count);
  }
}

void read_all(const NetcdfFile& file) {
  read_attributes(file, NC_GLOBAL);
  for (const std::string& name : file.variables()) {
    const int variable = file.find_variable(name);
    read_attributes(file, variable);
    nc_type type = NC_NAT;
    file.check(nc_inq_vartype(file.id(), variable, &type), "read the type of a variable");
    if (type == NC_CHAR) {
      file.read_texts(variable);
    } else if (type < NC_STRING) {  // no other kind is ever asked for
      read_values(file, variable);
    }
  }
}

void bound(decltype(RLIMIT_CPU) resource, rlim_t most) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(most, limit.rlim_max);
  setrlimit(resource, &limit);
}

// What a sound file takes is far below.
void bound_resources(const std::string& path) {
  constexpr rlim_t kMoreMemory = rlim_t{4} << 30U;
  constexpr rlim_t kSeconds = 3, kBytesPerSecond = 200'000;
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  bound(RLIMIT_CPU, kSeconds + (error ? 0 : bytes / kBytesPerSecond));
  bound(RLIMIT_CORE, 0);
  rlim_t pages = 0;
  if (std::ifstream("/proc/self/statm") >> pages) {
    bound(RLIMIT_AS, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + kMoreMemory);
  }
}

// All that the process does that reads. What a dying library says is not for the user. Signals that
// the user sends are for the process that waits, and this one ends with it.
[[noreturn]] void read_and_exit(const std::string& path, int verdict) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  bound_resources(path);
  try {
    read_all(NetcdfFile::open(path));
    if (write(verdict, &kSound, 1) == 1) _exit(0);
  } catch (const std::exception&) {
    // Whatever it is, no verdict says it.
  }
  _exit(1);
}

}  // namespace

void ensure_not_broken(const std::string& path) {
  if (!has_regular_file(path, "a result") || !is_netcdf(path)) return;
  Pipe verdict("the process that reads the file first");
  const pid_t child = fork();
  if (child < 0) {
    throw RunError(
        fmt::format("cannot start a process to read '{}' first: {}", path, std::strerror(errno)));
  }
  if (child == 0) read_and_exit(path, verdict.writer());
  verdict.close_writer();
  const bool is_sound = verdict.read_all() == std::string(1, kSound);
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (is_sound) return;
  throw InputError(fmt::format(
      "'{}' cannot be read to its end: it is cut short, otherwise damaged, or not written by "
      "gearsweep",
      path));
}

}  // namespace gearsweep
