#include "scheduler/scheduler.hpp"

namespace gearsweep {

Task::Task(std::shared_ptr<Scheduler> scheduler, int priority)
    : scheduler_(std::move(scheduler)), priority_(priority) {
  const std::lock_guard lock(scheduler_->mutex_);
  scheduler_->priorities_.insert(priority_);
}

Task::~Task() {
  const std::lock_guard lock(scheduler_->mutex_);
  scheduler_->priorities_.extract(priority_);
  scheduler_->has_changed_.notify_all();
}

bool Task::may_go_on() {
  std::unique_lock lock(scheduler_->mutex_);
  scheduler_->has_changed_.wait(
      lock, [this] { return is_cancelled_ || priority_ >= *scheduler_->priorities_.rbegin(); });
  return !is_cancelled_;
}

void Task::cancel() {
  const std::lock_guard lock(scheduler_->mutex_);
  is_cancelled_ = true;
  scheduler_->has_changed_.notify_all();
}

bool Task::is_cancelled() const {
  const std::lock_guard lock(scheduler_->mutex_);
  return is_cancelled_;
}

}  // namespace gearsweep
