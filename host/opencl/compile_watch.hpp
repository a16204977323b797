// Device compilers at work. They may take minutes, and nothing can stop them but the end of the
// process.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace gearsweep {

class CompileWatch {
 public:
  // Before any of them begins. told: once, from a thread of its own, of the first that takes longer
  // than a moment.
  void on_long(std::function<void()> told) { told_ = std::move(told); }
  bool is_at_work() const { return at_work_ > 0; }

  // A compiler is at work while it lives.
  class Work {
   public:
    explicit Work(CompileWatch* watch);
    ~Work();
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;

   private:
    CompileWatch* watch_;
    std::jthread teller_;
  };

 private:
  void tell_if_long(const std::stop_token& stop);

  std::function<void()> told_;
  std::atomic<bool> has_told_ = false;
  std::atomic<int> at_work_ = 0;
  std::mutex mutex_;
  std::condition_variable_any ended_;
};

}  // namespace gearsweep
