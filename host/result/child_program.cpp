#include "result/child_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <string_view>
#include <thread>

#include "model/error.hpp"
#include "result/pipe.hpp"

extern char** environ;

namespace gearsweep {
namespace {

// Signals do to the new process what they do by themselves, whatever this one does about them. One
// that may be killed leads a group of its own, with all that it starts.
class SpawnAttributes {
 public:
  explicit SpawnAttributes(bool leads_group) {
    posix_spawnattr_init(&attributes_);
    sigset_t none, ignored;
    sigemptyset(&none);
    sigemptyset(&ignored);
    for (const int signal_number : {SIGPIPE, SIGXFSZ}) sigaddset(&ignored, signal_number);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setsigdefault(&attributes_, &ignored);
    const int group = leads_group ? POSIX_SPAWN_SETPGROUP : 0;
    posix_spawnattr_setflags(
        &attributes_, static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | group));
  }
  ~SpawnAttributes() { posix_spawnattr_destroy(&attributes_); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;

  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_;
};

std::string_view name_of(std::string_view entry) { return entry.substr(0, entry.find('=')); }

std::vector<std::string> environment_with(const std::vector<std::string>& variables) {
  std::vector<std::string> entries = variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const bool is_replaced = std::ranges::any_of(
        variables, [&](const std::string& own) { return name_of(own) == name_of(*entry); });
    if (!is_replaced) entries.emplace_back(*entry);
  }
  return entries;
}

// As exec() takes a list; it lives as long as the words do.
std::vector<char*> pointers_to(std::vector<std::string>* words) {
  std::vector<char*> pointers;
  for (std::string& word : *words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// Its output and messages go to the pipe. Returns errno's kind of code.
int spawn(std::vector<std::string>* words, const std::vector<std::string>& variables,
          bool leads_group, const Pipe& messages, pid_t* child) {
  std::vector<std::string> entries = environment_with(variables);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, messages.writer(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.writer(), STDERR_FILENO);
  const SpawnAttributes attributes(leads_group);
  const int code = posix_spawnp(child, words->front().c_str(), &actions, attributes.get(),
                                pointers_to(words).data(), pointers_to(&entries).data());
  posix_spawn_file_actions_destroy(&actions);
  return code;
}

// Kills the group that a process leads when the time is over, unless this is destroyed before. The
// process must not have been waited for until then: its number is its own so long.
class TimeLimit {
 public:
  TimeLimit(pid_t leader, double seconds) {
    if (seconds <= 0.0) return;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    killer_ = std::jthread([this, leader, end](const std::stop_token& stop) {
      std::unique_lock lock(mutex_);
      if (over_.wait_until(lock, stop, end, [] { return false; }) || stop.stop_requested()) return;
      is_over_ = true;
      kill(-leader, SIGKILL);
    });
  }
  bool is_over() const { return is_over_; }

 private:
  std::mutex mutex_;
  std::condition_variable_any over_;
  std::atomic<bool> is_over_ = false;
  std::jthread killer_;  // the last, so that it ends first
};

}  // namespace

ChildEnd run_child(std::vector<std::string> words, const std::vector<std::string>& variables,
                   double seconds, const std::string& name) {
  constexpr int kNotFoundByShell = 127;
  Pipe messages(name);
  pid_t child = -1;
  const int code = spawn(&words, variables, seconds > 0.0, messages, &child);
  ChildEnd end;
  if (code == ENOENT) {
    end.is_found = false;
    return end;
  }
  if (code != 0) throw RunError(fmt::format("cannot start {}: {}", name, std::strerror(code)));
  messages.close_writer();
  {
    const TimeLimit limit(child, seconds);
    end.said = messages.read_all();
    siginfo_t info{};
    while (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT) < 0 &&
           errno == EINTR) {
    }
    end.is_in_time = !limit.is_over();
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  end.is_found = !(WIFEXITED(status) && WEXITSTATUS(status) == kNotFoundByShell);
  end.is_well = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return end;
}

}  // namespace gearsweep
