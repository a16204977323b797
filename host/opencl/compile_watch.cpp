#include "opencl/compile_watch.hpp"

#include <chrono>

namespace gearsweep {

void CompileWatch::tell_if_long(const std::stop_token& stop) {
  constexpr std::chrono::seconds kMoment{3};
  std::unique_lock lock(mutex_);
  ended_.wait_for(lock, stop, kMoment, [] { return false; });
  if (!stop.stop_requested() && !has_told_.exchange(true)) told_();
}

CompileWatch::Work::Work(CompileWatch* watch) : watch_(watch) {
  ++watch_->at_work_;
  if (!watch_->told_ || watch_->has_told_) return;
  teller_ = std::jthread([watch](const std::stop_token& stop) { watch->tell_if_long(stop); });
}

CompileWatch::Work::~Work() { --watch_->at_work_; }

}  // namespace gearsweep
