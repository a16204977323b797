// How long a device has been at work for a sweep.
#pragma once

#include <chrono>
#include <mutex>

namespace gearsweep {

// Launches that overlap, of several engines on one device, count once. Engines may use it from
// threads of their own.
class BusyClock {
 public:
  // Runs a launch to its end, and gives the seconds that this took.
  template <class Launch>
  double time(const Launch& launch) {
    const Running running(this);
    launch();
    return std::chrono::duration<double>(Clock::now() - running.start).count();
  }

  // In which some launch was running, up to now.
  double seconds() const {
    const std::lock_guard lock(mutex_);
    std::chrono::duration<double> sum = busy_;
    if (running_ > 0) sum += Clock::now() - busy_since_;
    return sum.count();
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Counts a launch as running, even one that throws, until it ends.
  struct Running {
    explicit Running(BusyClock* of) : clock(of), start(clock->begin()) {}
    ~Running() { clock->end(); }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    BusyClock* clock;
    Clock::time_point start;
  };

  Clock::time_point begin() {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (running_++ == 0) busy_since_ = now;
    return now;
  }

  void end() {
    const std::lock_guard lock(mutex_);
    if (--running_ == 0) busy_ += Clock::now() - busy_since_;
  }

  mutable std::mutex mutex_;
  int running_ = 0;
  Clock::time_point busy_since_;
  Clock::duration busy_{};
};

}  // namespace gearsweep
