// A plan that is computed in the background, for whoever takes its answers.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "engine/device_choice.hpp"
#include "engine/warn.hpp"
#include "plan/plan.hpp"
#include "scheduler/scheduler.hpp"

namespace gearsweep {

struct TileResult;

// Takes the answers for a tile of the plan, in any order, from a thread of the work's own. It must
// not wait for work of a lower priority, which waits for this one.
using TakeTile = std::function<void(std::size_t tile, const TileResult& result)>;

struct WorkRequest {
  std::shared_ptr<const Plan> plan;        // of one stage: no point goes on from another
  int priority = 0;                        // as of Task
  std::vector<DeviceChoice> devices = {};  // none: the default one
  TakeTile take = {};
  Warn warn = {};
};

// Computes from its construction on.
class Work {
 public:
  // Throws std::logic_error for a plan of several stages.
  Work(std::shared_ptr<Scheduler> scheduler, WorkRequest request);
  // Cancels it and waits until nothing of it computes any more.
  ~Work();
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  // Its tiles stop after their round; those that are finished were taken.
  void cancel();
  // Waits for its end. Whether all tiles were taken: false where it was cancelled. Throws what its
  // last device failed with, or what `take` threw.
  bool wait();

 private:
  bool compute();

  const std::shared_ptr<Scheduler> scheduler_;
  const WorkRequest request_;
  Task task_;
  std::mutex mutex_;
  std::condition_variable has_ended_;
  // Guarded by the mutex:
  bool is_over_ = false, is_whole_ = false;
  std::exception_ptr failure_;
  std::jthread thread_;  // the last member: it uses all others
};

// The content of a plan as text: two plans of equal keys have the same answers, tile by tile.
std::string key_of(const Plan& plan);

}  // namespace gearsweep
