#include "scheduler/work.hpp"

#include <fmt/format.h>

#include <deque>
#include <stdexcept>

#include "model/version.hpp"
#include "scheduler/make_engine.hpp"
#include "scheduler/thread_workers.hpp"

namespace gearsweep {

Work::Work(std::shared_ptr<Scheduler> scheduler, WorkRequest request)
    : scheduler_(std::move(scheduler)),
      request_(std::move(request)),
      task_(scheduler_, request_.priority) {
  if (request_.plan->stages().size() != 1) {
    throw std::logic_error("points that go on from each other are no work of one stage");
  }
  thread_ = std::jthread([this] {
    bool is_whole = false;
    std::exception_ptr failure;
    try {
      is_whole = compute();
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    is_whole_ = is_whole;
    failure_ = failure;
    has_ended_.notify_all();
  });
}

Work::~Work() { cancel(); }

void Work::cancel() { task_.cancel(); }

bool Work::wait() {
  std::unique_lock lock(mutex_);
  has_ended_.wait(lock, [this] { return is_over_; });
  if (failure_) std::rethrow_exception(failure_);
  return is_whole_;
}

bool Work::compute() {
  constexpr std::chrono::milliseconds kNap(100);
  const Plan& plan = *request_.plan;
  ThreadWorkers workers(
      plan, make_engines(plan.study(), request_.devices, scheduler_.get(), request_.warn), &task_);
  std::deque<std::size_t> waiting(plan.stages().front().tiles.size());
  for (std::size_t i = 0; i < waiting.size(); ++i) waiting[i] = i;
  std::size_t running = 0;
  std::exception_ptr lost;
  while (true) {
    if (task_.is_cancelled()) waiting.clear();
    for (; !waiting.empty() && workers.idle() > 0; ++running) {
      workers.start(waiting.front(), {});
      waiting.pop_front();
    }
    if (running == 0) break;
    const std::optional<WorkerReport> report = workers.wait(kNap);
    if (!report || report->kind == WorkerReport::Kind::progress ||
        report->kind == WorkerReport::Kind::more_work) {
      continue;
    }
    --running;
    if (report->kind == WorkerReport::Kind::finished) {
      request_.take(report->tile, report->result);
    } else if (report->kind == WorkerReport::Kind::lost) {
      lost = report->failure;
      waiting.push_front(report->tile);
    }
  }
  if (task_.is_cancelled()) return false;
  if (!waiting.empty()) std::rethrow_exception(lost);
  return true;
}

std::string key_of(const Plan& plan) {
  const Study& study = plan.study();
  // The steps of a point tell a plan with longer ones.
  const std::size_t steps = plan.steps_of(plan.points().point(0, 0));
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", source_hash(), study.toml,
                     study.integrate.max_step, study.integrate.orbit_steps, steps,
                     plan.tile_points(), plan.points().key());
}

}  // namespace gearsweep
