#include "measure/program_run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "model/error.hpp"
#include "result/output_file.hpp"

namespace gearsweep {
namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string name_of(const std::string& entry) { return entry.substr(0, entry.find('=')); }

// This process's own, changed as a call says.
std::vector<std::string> changed_environment(const std::vector<std::string>& changes) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const auto is_changed = [&](const std::string& change) {
      return name_of(change) == name_of(*entry);
    };
    if (std::none_of(changes.begin(), changes.end(), is_changed)) entries.emplace_back(*entry);
  }
  for (const std::string& change : changes) {
    if (change.find('=') != std::string::npos) entries.push_back(change);
  }
  return entries;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Its standard output and error go to these files.
pid_t start_program(std::vector<std::string> arguments, std::vector<std::string> environment,
                    const std::string& output, const std::string& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const auto open_as = [&](int number, const std::string& path) {
    posix_spawn_file_actions_addopen(&actions, number, path.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
  };
  open_as(STDOUT_FILENO, output);
  open_as(STDERR_FILENO, errors);
  pid_t child = 0;
  const int failure = posix_spawn(&child, arguments.front().c_str(), &actions, nullptr,
                                  pointers_to(arguments).data(), pointers_to(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw RunError(fmt::format("{}: cannot be started", arguments.front()));
  return child;
}

// Waits for its end, and kills it when `stop` is set: all that it leaves is in a temporary folder.
// When it ended.
std::chrono::steady_clock::time_point wait_for(pid_t child, const std::atomic<bool>* stop) {
  std::jthread killer;
  if (stop != nullptr) {
    killer = std::jthread([child, stop](const std::stop_token& ended) {
      constexpr std::chrono::milliseconds kPause(20);
      while (!ended.stop_requested() && !*stop) std::this_thread::sleep_for(kPause);
      if (!ended.stop_requested()) kill(child, SIGKILL);
    });
  }
  // It keeps its number until the killer has gone, so that nothing else is killed.
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  return std::chrono::steady_clock::now();
}

// What it used, once it has ended well.
rusage collect(pid_t child, const std::string& called, const std::string& errors) {
  int status = 0;
  rusage used{};
  if (wait4(child, &status, 0, &used) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    return used;
  }
  std::ostringstream said;
  said << std::ifstream(errors).rdbuf();
  throw RunError(fmt::format("{} failed: {}", called, said.str()));
}

}  // namespace

ProgramCost run_program(const std::string& program, const ProgramCall& call,
                        const std::atomic<bool>* stop) {
  const TemporaryFolder folder;
  const std::string summary = folder.path() / "summary.json", errors = folder.path() / "errors";
  std::vector<std::string> arguments = {
      program, "run", call.study, "-o", folder.path() / "maps.nc", "--quiet", "--json"};
  for (const std::string& assignment : call.overrides) {
    arguments.insert(arguments.end(), {"--set", assignment});
  }
  arguments.insert(arguments.end(), call.options.begin(), call.options.end());
  const auto start = std::chrono::steady_clock::now();
  const pid_t child =
      start_program(arguments, changed_environment(call.environment), summary, errors);
  const auto end = wait_for(child, stop);
  ProgramCost cost;
  cost.wall_seconds = std::chrono::duration<double>(end - start).count();
  const rusage used = collect(child, fmt::format("{}", fmt::join(arguments, " ")), errors);
  std::ifstream in(summary);
  const nlohmann::json json = nlohmann::json::parse(in);
  cost.points = json.at("points").get<double>();
  cost.steps = json.at("steps").get<double>();
  cost.computing_seconds = json.at("seconds").get<double>();
  cost.core_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  cost.peak_bytes = 1024.0 * static_cast<double>(used.ru_maxrss);
  return cost;
}

}  // namespace gearsweep
