// The workers of this process: one thread for each engine.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "scheduler/scheduler.hpp"
#include "scheduler/worker_pool.hpp"

namespace gearsweep {

class ThreadWorkers final : public WorkerPool {
 public:
  // The plan and the task outlive the pool. One engine at least.
  ThreadWorkers(const Plan& plan, std::vector<std::unique_ptr<Engine>> engines, Task* task);
  // Stops what is running.
  ~ThreadWorkers() override;
  ThreadWorkers(const ThreadWorkers&) = delete;
  ThreadWorkers& operator=(const ThreadWorkers&) = delete;

  std::size_t size() const override;
  std::size_t idle() const override;
  void start(std::size_t tile, std::vector<double> initial) override;
  std::optional<WorkerReport> wait(std::chrono::milliseconds patience) override;
  void stop() override;

 private:
  struct Job {
    std::size_t tile = 0;
    std::vector<double> initial;
  };
  // All that a worker's thread does: it takes the jobs that start() leaves, one after the other,
  // and reports each for wait() to find.
  void serve(Engine* engine);
  // Runs the tile (run_tile()).
  WorkerReport compute(const Job& job, Engine* engine);
  // Waits until there is one. Nothing when no more will come.
  std::optional<Job> next_job();
  void report(WorkerReport report);

  const Plan& plan_;
  const std::vector<const Tile*> tiles_;
  const std::vector<std::unique_ptr<Engine>> engines_;
  Task* const task_;
  mutable std::mutex mutex_;
  std::condition_variable has_job_, has_report_;
  // Guarded by the mutex:
  std::deque<Job> jobs_;
  std::deque<WorkerReport> reports_;
  std::size_t size_ = 0, busy_ = 0;
  bool closes_ = false;  // no more jobs
  std::vector<std::jthread> threads_;
};

}  // namespace gearsweep
