// Who computes the tiles of a plan: any number of workers, each with one tile at a time. Whoever
// drives a worker pool hands out tiles and hears what becomes of them, from one thread.
#pragma once

#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

struct WorkerReport {
  enum class Kind {
    progress,   // `steps` of the tile were taken
    more_work,  // the tile takes `steps` more than planned (fewer: negative)
    finished,   // `result` is the tile's
    stopped,    // as stop() asked; the tile is not finished
    lost        // the worker has failed and is gone; its tile is not finished
  };
  Kind kind = Kind::progress;
  std::size_t tile = 0;  // its number in the plan
  double steps = 0.0;
  TileResult result = {};
  std::exception_ptr failure = {};  // of a lost worker
};

class WorkerPool {
 public:
  virtual ~WorkerPool() = default;

  virtual std::size_t size() const = 0;            // workers, those that are lost left out
  virtual bool may_grow() const { return false; }  // others are still to come
  // Those of them that have no tile. A worker whose tile has ended is idle, or lost, once wait()
  // has told so: however slow the driver is, no more results than workers wait for it.
  virtual std::size_t idle() const = 0;
  // Gives a tile to an idle worker, and does not wait: some thread, here or in another process,
  // takes it up in ThreadWorkers::serve() and computes it with run_tile() (tile/tile_run.hpp).
  // initial: [point of the tile][state]; empty: each point's own.
  virtual void start(std::size_t tile, std::vector<double> initial) = 0;
  // The next report; nothing when there was none for so long.
  virtual std::optional<WorkerReport> wait(std::chrono::milliseconds patience) = 0;
  // The running tiles are to stop after their round.
  virtual void stop() = 0;
};

}  // namespace gearsweep
