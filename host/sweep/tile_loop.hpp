// Computes every tile of a sweep that its journal does not have.
#pragma once

#include <chrono>
#include <deque>
#include <exception>
#include <map>
#include <vector>

#include "journal/journal.hpp"
#include "scheduler/worker_pool.hpp"
#include "sweep/assembly.hpp"
#include "sweep/progress.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

class TileLoop {
 public:
  // All outlive the loop; the journal may be null.
  TileLoop(const Plan& plan, const SweepOptions& options, WorkerPool* workers, Journal* journal,
           Assembly* assembly);

  // False when stopped. Throws what the last worker has failed with, or RunError
  // when the journal cannot be written.
  bool run();

 private:
  // Adds the tiles that the journal has; the others wait for a worker.
  void queue_tiles(std::size_t first, std::size_t count);
  void stop_if_asked();
  void start_tiles();
  void handle(WorkerReport report);
  void hand_back(const WorkerReport& report);
  void share_time();
  void set_time(WorkerReport* report);
  void add(std::size_t number, const TileResult& result, bool resumed);

  const Plan& plan_;
  const SweepOptions& options_;
  const std::vector<const Tile*> tiles_;
  WorkerPool* workers_;
  Journal* journal_;
  Assembly* assembly_;
  Progress progress_;
  std::deque<std::size_t> waiting_;
  std::map<std::size_t, double> running_;  // [tile] its share of the sweep's seconds so far
  std::chrono::steady_clock::time_point last_share_ = std::chrono::steady_clock::now();
  bool is_stopping_ = false;
  std::exception_ptr failure_;  // of the worker that was lost last
};

}  // namespace gearsweep
