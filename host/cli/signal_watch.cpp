#include "cli/signal_watch.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <chrono>
#include <cstdio>

namespace gearsweep {
namespace {

sigset_t watched_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

// Lets the signal do what it does to a program that does not handle it.
void die_by(int signal_number) {
  const sigset_t signals = watched_signals();
  ::signal(signal_number, SIG_DFL);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  raise(signal_number);
}

}  // namespace

SignalWatch::SignalWatch() {
  // A file beyond the limit of its size (ulimit -f) is an error to be told, like a full disk.
  ::signal(SIGXFSZ, SIG_IGN);
  block_signals();
  const sigset_t signals = watched_signals();
  watcher_ = std::jthread([this, signals](const std::stop_token& stop) {
    const timespec pause = {0, 50'000'000};
    auto first = std::chrono::steady_clock::now();
    while (!stop.stop_requested()) {
      const int signal_number = sigtimedwait(&signals, nullptr, &pause);
      if (signal_number < 0) continue;
      const auto now = std::chrono::steady_clock::now();
      if (interrupted_) {
        // Some programs send a signal to the process and to its group: that is one request.
        if (now - first > std::chrono::seconds(1)) die_by(signal_number);
        continue;
      }
      first = now;
      interrupted_ = true;
      fmt::print(stderr, "\ngearsweep: finishing the running round; once more to stop at once\n");
    }
  });
}

void block_signals() {
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace gearsweep
