#include "command.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "model/error.hpp"
#include "result/output_file.hpp"

namespace gearsweep::bench {
namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Runs a program with its standard output in a file; what it used.
rusage run_program(std::vector<std::string> arguments, std::vector<std::string> environment,
                   const std::string& output) {
  for (char** entry = environ; *entry != nullptr; ++entry) environment.emplace_back(*entry);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                   O_WRONLY | O_CREAT | O_TRUNC, 0600);
  pid_t child = 0;
  const int failure = posix_spawn(&child, arguments.front().c_str(), &actions, nullptr,
                                  pointers_to(arguments).data(), pointers_to(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) throw RunError(fmt::format("{}: cannot be started", arguments.front()));
  int status = 0;
  rusage used{};
  if (wait4(child, &status, 0, &used) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw RunError(fmt::format("{} failed", fmt::join(arguments, " ")));
  }
  return used;
}

}  // namespace

Outcome run(const Command& command) {
  const TemporaryFolder folder;
  const std::string summary = folder.path() / "summary.json";
  std::vector<std::string> arguments = {GEARSWEEP_BINARY,          "run",     command.study, "-o",
                                        folder.path() / "maps.nc", "--quiet", "--json"};
  for (const std::string& assignment : command.overrides) {
    arguments.insert(arguments.end(), {"--set", assignment});
  }
  arguments.insert(arguments.end(), command.options.begin(), command.options.end());
  const auto start = std::chrono::steady_clock::now();
  const rusage used = run_program(arguments, command.environment, summary);
  Outcome outcome;
  outcome.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::ifstream in(summary);
  const nlohmann::json json = nlohmann::json::parse(in);
  outcome.points = json.at("points").get<double>();
  outcome.steps = json.at("steps").get<double>();
  outcome.computing_seconds = json.at("seconds").get<double>();
  outcome.core_seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime);
  outcome.peak_bytes = 1024.0 * static_cast<double>(used.ru_maxrss);
  return outcome;
}

}  // namespace gearsweep::bench
