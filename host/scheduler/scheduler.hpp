// What outlives every plan: the devices that a process has opened, with the programs that were
// built for them, and whose turn it is to compute there.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>

#include "opencl/open_devices.hpp"

namespace gearsweep {

class Scheduler;

// A piece of work from its beginning until it is destroyed. Threads may share one.
class Task {
 public:
  // Among the tasks that are there at one time those of the highest priority compute.
  Task(std::shared_ptr<Scheduler> scheduler, int priority);
  ~Task();
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  // Called by whoever computes it, between two rounds: waits while there is a task of a higher
  // priority. False once it is cancelled. What it has on a device stays there meanwhile.
  bool may_go_on();
  void cancel();
  bool is_cancelled() const;

 private:
  const std::shared_ptr<Scheduler> scheduler_;
  const int priority_;
  bool is_cancelled_ = false;  // guarded by the scheduler's mutex
};

// Threads may share one.
class Scheduler {
 public:
  // Opened at the first use; what is built for one is there for the next task.
  OpenDevices& devices() { return devices_; }
  CompileWatch& compile_watch() { return devices_.compile_watch(); }

 private:
  friend Task;

  OpenDevices devices_;
  std::mutex mutex_;
  std::condition_variable has_changed_;
  std::multiset<int> priorities_;  // of the tasks that are there
};

}  // namespace gearsweep
