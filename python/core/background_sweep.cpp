#include "core/background_sweep.hpp"

#include <utility>

#include "model/error.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::python {

BackgroundSweep::BackgroundSweep(const Study& study, SweepOptions options)
    : study_(study), options_(std::move(options)) {
  options_.stop = &stop_;
  options_.on_progress = [this](const SweepProgress& progress) {
    const std::lock_guard lock(mutex_);
    progress_ = progress;
    news_.notify_one();
  };
  options_.on_trouble = [this](const std::string& trouble) {
    const std::lock_guard lock(mutex_);
    troubles_.push_back(trouble);
  };
  thread_ = std::thread([this] { compute(); });
}

void BackgroundSweep::compute() {
  std::optional<SweepResult> result;
  std::exception_ptr failure;
  try {
    result = run_sweep(study_, options_);
  } catch (...) {
    failure = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  result_ = std::move(result);
  failure_ = failure;
  has_ended_ = true;
  news_.notify_one();
}

bool BackgroundSweep::wait(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, most, [this] { return has_ended_ || progress_; });
  return has_ended_;
}

std::optional<SweepProgress> BackgroundSweep::progress() {
  const std::lock_guard lock(mutex_);
  return std::exchange(progress_, std::nullopt);
}

void BackgroundSweep::finish() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

SweepResult BackgroundSweep::take() {
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(failure_);
  if (!result_) throw RunError("the run was stopped");
  return std::move(*result_);
}

std::vector<std::string> BackgroundSweep::troubles() {
  const std::lock_guard lock(mutex_);
  return troubles_;
}

}  // namespace gearsweep::python
