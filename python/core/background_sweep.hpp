// A sweep on a thread of its own, for a caller who has to listen to something else meanwhile.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sweep/sweep_options.hpp"

namespace gearsweep::python {

class BackgroundSweep {
 public:
  // Begins. The study outlives it. Progress, troubles and the wish to stop go through this.
  BackgroundSweep(const Study& study, SweepOptions options);
  ~BackgroundSweep() { finish(); }
  BackgroundSweep(const BackgroundSweep&) = delete;
  BackgroundSweep& operator=(const BackgroundSweep&) = delete;

  // Waits for news, but not for longer than `most`. True when the sweep has ended.
  bool wait(std::chrono::milliseconds most);
  // The latest progress that was not asked for yet.
  std::optional<SweepProgress> progress();
  // Stops it, and waits until the running round is over.
  void finish();

  // Once it has ended. Throws what the sweep has thrown.
  SweepResult take();
  // What went wrong while the rest went on.
  std::vector<std::string> troubles();

 private:
  void compute();

  const Study& study_;
  SweepOptions options_;
  std::atomic<bool> stop_ = false;
  std::mutex mutex_;
  std::condition_variable news_;
  std::optional<SweepProgress> progress_;
  std::vector<std::string> troubles_;
  std::optional<SweepResult> result_;
  std::exception_ptr failure_;
  bool has_ended_ = false;
  std::thread thread_;  // the last, since it uses the others
};

}  // namespace gearsweep::python
