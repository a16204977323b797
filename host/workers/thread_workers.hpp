// A crew of this process: one thread for each engine.
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

#include "workers/worker_pool.hpp"

namespace gearsweep {

class LocalCrew final : public Crew {
 public:
  // The plan outlives the crew. One engine at least.
  LocalCrew(const Plan& plan, std::vector<std::unique_ptr<Engine>> engines);
  // Stops what is running.
  ~LocalCrew() override;
  LocalCrew(const LocalCrew&) = delete;
  LocalCrew& operator=(const LocalCrew&) = delete;

  std::size_t size() const override;
  std::size_t idle() const override;
  void start(std::size_t tile, std::vector<double> initial) override;
  std::optional<CrewReport> wait(std::chrono::milliseconds patience) override;
  void stop() override;

 private:
  struct Task {
    std::size_t tile = 0;
    std::vector<double> initial;
  };
  void serve(Engine* engine);
  CrewReport compute(const Task& task, Engine* engine);
  std::optional<Task> next_task();
  void report(CrewReport report);

  const Plan& plan_;
  const std::vector<const Tile*> tiles_;
  const std::vector<std::unique_ptr<Engine>> engines_;
  mutable std::mutex mutex_;
  std::condition_variable has_task_, has_report_;
  // Guarded by the mutex:
  std::deque<Task> tasks_;
  std::deque<CrewReport> reports_;
  std::size_t size_ = 0, busy_ = 0;
  bool stops_ = false;   // running tiles stop
  bool closes_ = false;  // no more tasks
  std::vector<std::jthread> threads_;
};

}  // namespace gearsweep
