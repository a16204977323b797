#include "cli/signal_watch.hpp"

#include <fmt/format.h>
#include <signal.h>

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
  const sigset_t signals = watched_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  watcher_ = std::jthread([this, signals](const std::stop_token& stop) {
    const timespec pause = {0, 50'000'000};
    while (!stop.stop_requested()) {
      const int signal_number = sigtimedwait(&signals, nullptr, &pause);
      if (signal_number < 0) continue;
      if (interrupted_) die_by(signal_number);
      interrupted_ = true;
      fmt::print(stderr, "\ngearsweep: finishing the running round; once more to stop at once\n");
    }
  });
}

}  // namespace gearsweep
