// Work on a thread of its own, for Python, which listens to its user meanwhile.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace gearsweep::python {

// Python must not end while one lives: a thread that is kept from the GIL then is torn out of the
// functions of C++ that it is in, which aborts the process. To be made and destroyed with the GIL,
// as the call guard of every function that lets go of it. One that is made while Python ends throws
// SystemExit.
class Computation {
 public:
  Computation();
  ~Computation();
  Computation(const Computation&) = delete;
  Computation& operator=(const Computation&) = delete;
};

// Makes Python stop all computations at its end, and wait for them.
void stop_computations_at_exit();

// Runs `work` on another thread and lets go of the GIL until it has returned. Every now and then,
// and at the end, it calls `meanwhile` with the GIL. After Ctrl-C, or when `meanwhile` throws, it
// sets `stop`, waits for the work, and throws that; otherwise what the work has thrown. At the end
// of Python it throws SystemExit in this way, which ends a thread without a word. To be called with
// the GIL and within a Computation; the work does not have the GIL.
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
