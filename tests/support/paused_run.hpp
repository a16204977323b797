// A run of the gearsweep program that is paused in the middle of a write: what a test does to it
// then comes neither too early nor too late.
#pragma once

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <thread>

#include "support/process.hpp"

namespace gearsweep::testing {

// For a shell: the program pauses in the `at`-th write to a file whose name ends so, and goes on
// once `mark`, which it makes then, is removed.
inline std::string paused_in(const std::string& ending, long at, const std::string& mark) {
  return "LD_PRELOAD=" PAUSING_WRITE " PAUSE_IN=" + ending + " PAUSE_AT=" + std::to_string(at) +
         " PAUSE_FILE='" + mark + "' ";
}

// For a shell: waits for a file, for as long as the process `pid` of the shell lives.
inline std::string wait_for(const std::string& file) {
  return "while kill -0 $pid && ! [ -e " + file + " ]; do sleep 0.01; done; ";
}

// How many such writes an unbroken run makes: "run study.toml -o whole.nc".
inline long count_writes(const Folder& folder, const std::string& arguments,
                         const std::string& ending) {
  const Folder own;
  const std::string file = (own / "writes").string();
  const Outcome outcome =
      run_in(folder, "env LD_PRELOAD=" PAUSING_WRITE " PAUSE_IN=" + ending + " WRITES_FILE='" +
                         file + "' " GEARSWEEP_BINARY " " + arguments);
  if (outcome.status != 0) throw std::runtime_error("the run failed: " + outcome.err);
  return std::stol("0" + read_all(file));
}

class PausedRun {
 public:
  // Starts "run study.toml -o out.nc" and waits until it pauses, or has ended before.
  PausedRun(const Folder& folder, const std::string& arguments, const std::string& ending,
            long at) {
    const std::string line = "cd '" + folder.path().string() + "' && exec env " +
                             paused_in(ending, at, mark()) + GEARSWEEP_BINARY " " + arguments +
                             " 2> '" + (own_ / "err").string() + "'";
    process_ = fork();
    if (process_ == 0) {
      execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
      _exit(127);
    }
    wait_until([&] { return is_paused(); });
  }
  ~PausedRun() {
    if (status_) return;
    send(SIGKILL);
    end();
  }
  PausedRun(const PausedRun&) = delete;
  PausedRun& operator=(const PausedRun&) = delete;

  bool is_paused() const { return std::filesystem::exists(own_ / "paused"); }
  void go_on() { std::filesystem::remove(own_ / "paused"); }
  void send(int signal_number) const { kill(process_, signal_number); }
  std::string said() const { return read_all(own_ / "err"); }
  // Waits until it has said so, or has ended.
  void wait_for_words(const std::string& words) {
    wait_until([&] { return said().find(words) != std::string::npos; });
  }
  // Waits for its end; the status is that which a shell gives.
  int end() {
    wait_until([] { return false; });
    return *status_;
  }

 private:
  std::string mark() const { return (own_ / "paused").string(); }

  template <class Condition>
  void wait_until(const Condition& condition) {
    while (!status_ && !condition()) {
      int status = 0;
      if (waitpid(process_, &status, WNOHANG) == process_) {
        status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
  }

  Folder own_;
  pid_t process_ = -1;
  std::optional<int> status_;
};

}  // namespace gearsweep::testing
