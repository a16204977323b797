#include "scheduler/thread_workers.hpp"

#include "tile/subset.hpp"
#include "tile/tile_run.hpp"

namespace gearsweep {

ThreadWorkers::ThreadWorkers(const Plan& plan, std::vector<std::unique_ptr<Engine>> engines,
                             Task* task)
    : plan_(plan),
      tiles_(tiles_of(plan)),
      engines_(std::move(engines)),
      task_(task),
      size_(engines_.size()) {
  for (const std::unique_ptr<Engine>& engine : engines_) {
    threads_.emplace_back([this, &engine] { serve(engine.get()); });
  }
}

ThreadWorkers::~ThreadWorkers() {
  {
    const std::lock_guard lock(mutex_);
    closes_ = true;
    has_job_.notify_all();
  }
  task_->cancel();
  threads_.clear();  // joins
}

std::size_t ThreadWorkers::size() const {
  const std::lock_guard lock(mutex_);
  return size_;
}

std::size_t ThreadWorkers::idle() const {
  const std::lock_guard lock(mutex_);
  return size_ - busy_;
}

void ThreadWorkers::start(std::size_t tile, std::vector<double> initial) {
  const std::lock_guard lock(mutex_);
  jobs_.push_back({tile, std::move(initial)});
  ++busy_;
  has_job_.notify_one();
}

std::optional<WorkerReport> ThreadWorkers::wait(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  if (!has_report_.wait_for(lock, patience, [&] { return !reports_.empty(); })) {
    return std::nullopt;
  }
  WorkerReport report = std::move(reports_.front());
  reports_.pop_front();
  const bool goes_on =
      report.kind == WorkerReport::Kind::progress || report.kind == WorkerReport::Kind::more_work;
  if (!goes_on) --busy_;
  if (report.kind == WorkerReport::Kind::lost) --size_;
  return report;
}

void ThreadWorkers::stop() { task_->cancel(); }

void ThreadWorkers::serve(Engine* engine) {
  while (const std::optional<Job> job = next_job()) {
    WorkerReport done;
    try {
      done = compute(*job, engine);
    } catch (...) {
      done = {WorkerReport::Kind::lost, job->tile, 0.0, {}, std::current_exception()};
    }
    const bool is_lost = done.kind == WorkerReport::Kind::lost;
    report(std::move(done));
    if (is_lost) return;
  }
}

WorkerReport ThreadWorkers::compute(const Job& job, Engine* engine) {
  const Tile& tile = *tiles_[job.tile];
  double steps = 0.0;
  TileCallbacks callbacks;
  callbacks.after_round = [&](double round_steps) {
    steps += round_steps;
    report({.kind = WorkerReport::Kind::progress, .tile = job.tile, .steps = round_steps});
    return task_->may_go_on();
  };
  callbacks.on_work = [&](double more) {
    report({.kind = WorkerReport::Kind::more_work, .tile = job.tile, .steps = more});
  };
  const auto start = std::chrono::steady_clock::now();
  const double in_kernels = engine->kernel_seconds();
  std::optional<TileResult> result =
      run_tile(plan_, tile, job.initial.empty() ? own_initial_states(plan_, tile) : job.initial,
               engine, callbacks);
  if (!result) return {.kind = WorkerReport::Kind::stopped, .tile = job.tile};
  result->cost.steps = steps;
  result->cost.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result->cost.kernel_seconds = engine->kernel_seconds() - in_kernels;
  result->device = engine->info().device;
  if (!has_final_states(plan_.study(), tile)) result->final_states.clear();
  return {.kind = WorkerReport::Kind::finished, .tile = job.tile, .result = std::move(*result)};
}

std::optional<ThreadWorkers::Job> ThreadWorkers::next_job() {
  std::unique_lock lock(mutex_);
  has_job_.wait(lock, [&] { return closes_ || !jobs_.empty(); });
  if (closes_) return std::nullopt;
  Job job = std::move(jobs_.front());
  jobs_.pop_front();
  return job;
}

void ThreadWorkers::report(WorkerReport report) {
  const std::lock_guard lock(mutex_);
  reports_.push_back(std::move(report));
  has_report_.notify_one();
}

}  // namespace gearsweep
