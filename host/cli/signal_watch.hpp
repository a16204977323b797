// Ctrl-C and SIGTERM as a flag. Private to this folder.
#pragma once

#include <atomic>
#include <thread>

namespace gearsweep {

// While it lives, the first SIGINT or SIGTERM sets the flag and the second ends the process. Make
// it before other threads start: they inherit the signal mask that lets only the watch see the
// signals.
class SignalWatch {
 public:
  SignalWatch();
  const std::atomic<bool>& interrupted() const { return interrupted_; }

 private:
  std::atomic<bool> interrupted_ = false;
  std::jthread watcher_;
};

// From now on neither signal does anything to this process.
void ignore_signals();

}  // namespace gearsweep
