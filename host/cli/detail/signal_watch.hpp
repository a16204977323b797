// SIGINT and SIGTERM.
#pragma once

#include <atomic>
#include <functional>
#include <thread>

namespace gearsweep {

enum class OnSignal {
  end,     // the program
  stop,    // the command, which looks at the flag; a second signal ends the program
  nothing  // signals are another process's, of which there are several
};

// Sees both signals from its making on; at first they end the program.
class SignalWatch {
 public:
  // Before anything starts threads, drivers and MPI included: they inherit the signal mask that
  // lets only the watch see the signals. on_end: what is still done when a signal ends the program.
  explicit SignalWatch(std::function<void()> on_end);
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  void set(OnSignal what) { on_signal_ = what; }
  // Before set(OnSignal::stop): while this says so, the first signal ends the program, too.
  void end_while(std::function<bool()> cannot_stop) { cannot_stop_ = std::move(cannot_stop); }
  // Whether the command is to stop.
  const std::atomic<bool>& interrupted() const { return interrupted_; }

 private:
  void watch(const std::stop_token& stop);
  [[noreturn]] void end(int signal_number);

  std::function<void()> on_end_;
  std::function<bool()> cannot_stop_;
  std::atomic<OnSignal> on_signal_ = OnSignal::end;
  std::atomic<bool> interrupted_ = false;
  std::jthread watcher_;
};

// Says that a signal has ended the command. Returns the exit status.
int tell_interrupted();

}  // namespace gearsweep
