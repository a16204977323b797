// The workers of all processes of a cluster, seen from rank 0.
//
// Rank 0 sends a job and tiles (their numbers, and states where a chain gives them); the others
// plan the same study themselves and send back what becomes of each tile.
#pragma once

#include "scheduler/cluster.hpp"
#include "scheduler/thread_workers.hpp"

namespace gearsweep {

class ClusterWorkers final : public WorkerPool {
 public:
  // own: the engines of this process. The plan, the task and the cluster outlive the pool.
  ClusterWorkers(const Plan& plan, std::vector<std::unique_ptr<Engine>> own, Task* task,
                 Cluster* cluster);

  bool may_grow() const override { return answers_ + 1 < others_.size(); }
  std::size_t size() const override;
  std::size_t idle() const override;
  // Sends the tile to a rank with an idle worker, whose serve_cluster() gives it to threads of its
  // own; those of this process come last.
  void start(std::size_t tile, std::vector<double> initial) override;
  std::optional<WorkerReport> wait(std::chrono::milliseconds patience) override;
  void stop() override;

 private:
  struct Others {
    std::size_t workers = 0, busy = 0;
  };
  std::optional<WorkerReport> take(const ClusterMessage& message);

  Cluster* cluster_;
  ThreadWorkers own_;
  std::size_t answers_ = 0;     // ranks that have told how many workers they have
  std::vector<Others> others_;  // [rank], that of rank 0 stays empty
};

}  // namespace gearsweep
