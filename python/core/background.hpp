// Work on a thread of its own, for Python, which listens to its user meanwhile.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace gearsweep::python {

// Runs `work` on another thread and lets go of the GIL until it has returned. Every now and then,
// and at the end, it calls `meanwhile` with the GIL. After Ctrl-C, or when `meanwhile` throws, it
// sets `stop`, waits for the work, and throws that; otherwise what the work has thrown. To be
// called with the GIL; the work does not have it.
void run_in_background(
    const std::function<void(const std::atomic<bool>& stop)>& work,
    const std::function<void()>& meanwhile = [] {});

// What the work has to tell: put in by its threads, taken out by the one that waits.
template <typename T>
class Mailbox {
 public:
  void put(T letter) {
    const std::lock_guard lock(mutex_);
    letters_.push_back(std::move(letter));
  }
  // All since the last call, in the order in which they came.
  std::vector<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(letters_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<T> letters_;
};

}  // namespace gearsweep::python
