// Computes every tile of a sweep that its journal does not have.
#pragma once

#include <chrono>
#include <deque>
#include <exception>
#include <map>
#include <vector>

#include "journal/journal.hpp"
#include "sweep/assembly.hpp"
#include "sweep/progress.hpp"
#include "sweep/sweep_options.hpp"
#include "workers/shard.hpp"
#include "workers/worker_pool.hpp"

namespace gearsweep {

class TileLoop {
 public:
  // All outlive the loop; the journal may be null.
  TileLoop(const Plan& plan, const Shard& shard, const SweepOptions& options, Crew* crew,
           Journal* journal, Assembly* assembly);

  // False when stopped. Throws what the last member of the crew has failed with, or RunError when
  // the journal cannot be written.
  bool run();

 private:
  void take_from_journal(std::size_t first, std::size_t count);
  void stop_if_asked();
  void start_tiles();
  void handle(CrewReport report);
  void hand_back(const CrewReport& report);
  void share_time();
  void set_time(CrewReport* report);
  void add(std::size_t number, const TileResult& result, bool resumed);

  const Plan& plan_;
  const Shard shard_;
  const SweepOptions& options_;
  const std::vector<const Tile*> tiles_;
  Crew* crew_;
  Journal* journal_;
  Assembly* assembly_;
  Progress progress_;
  std::deque<std::size_t> waiting_;
  std::map<std::size_t, double> running_;  // [tile] seconds of the sweep, shared between those
  std::chrono::steady_clock::time_point shared_ = std::chrono::steady_clock::now();
  bool is_stopping_ = false;
  std::exception_ptr failure_;  // of the member that was lost last
};

}  // namespace gearsweep
