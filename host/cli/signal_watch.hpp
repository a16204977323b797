// Ctrl-C and SIGTERM as a flag. Private to this folder.
#pragma once

#include <atomic>
#include <thread>

namespace gearsweep {

// While it lives, the first SIGINT or SIGTERM sets the flag and the second ends the process. Make
// it before other threads start, or call block_signals() then: they inherit the signal mask that
// lets only the watch see the signals.
class SignalWatch {
 public:
  SignalWatch();
  const std::atomic<bool>& interrupted() const { return interrupted_; }

 private:
  std::atomic<bool> interrupted_ = false;
  std::jthread watcher_;
};

// Keeps both signals from this thread and those that it starts: before anything starts threads,
// drivers and MPI included.
void block_signals();

}  // namespace gearsweep
