#include "cli/detail/signal_watch.hpp"

#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "cli/commands.hpp"
#include "cli/standard_streams.hpp"

namespace gearsweep {
namespace {

using Clock = std::chrono::steady_clock;

sigset_t watched_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void unblock_signals() {
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

// Or never: a signal does not wait for somebody to read.
void tell_now(std::string_view text) {
  if (is_heard()) tell_text(text);
}

}  // namespace

SignalWatch::SignalWatch(std::function<void()> on_end) : on_end_(std::move(on_end)) {
  // A file beyond the limit of its size (ulimit -f) is an error to be told, like a full disk; so is
  // a pipe that nobody reads.
  ::signal(SIGXFSZ, SIG_IGN);
  ::signal(SIGPIPE, SIG_IGN);
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

SignalWatch::~SignalWatch() {
  watcher_.request_stop();
  // It is blocked there and waited for: it wakes the watcher and ends nothing.
  // NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread)
  pthread_kill(watcher_.native_handle(), SIGTERM);
  watcher_.join();
  unblock_signals();
}

void SignalWatch::watch(const std::stop_token& stop) {
  const sigset_t signals = watched_signals();
  Clock::time_point first;
  for (;;) {
    int signal_number = 0;
    if (sigwait(&signals, &signal_number) != 0) continue;
    if (stop.stop_requested()) return;
    const OnSignal what = on_signal_;
    if (what == OnSignal::nothing) continue;
    const bool is_first = !interrupted_.exchange(true);
    if (is_first) first = Clock::now();
    if (what == OnSignal::end || (cannot_stop_ && cannot_stop_())) end(signal_number);
    if (is_first) {
      tell_now("\ngearsweep: finishing the running round; once more to stop at once\n");
    } else if (Clock::now() - first > std::chrono::seconds(1)) {
      // Some programs send a signal to the process and to its group: that is one request.
      end(signal_number);
    }
  }
}

void SignalWatch::end(int signal_number) {
  tell_now("gearsweep: interrupted\n");
  on_end_();
  if (signal_number == SIGINT) {
    // A shell ends its own loop, too, when what it has started dies of Ctrl-C.
    ::signal(SIGINT, SIG_DFL);
    unblock_signals();
    raise(SIGINT);
  }
  std::_Exit(kInterrupted);
}

int tell_interrupted() {
  tell("gearsweep: interrupted\n");
  return kInterrupted;
}

}  // namespace gearsweep
