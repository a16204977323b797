// The memory and disk that a study will need, known before it runs. All are upper bounds, in bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

// What it takes to write the finished maps (result/result_size.hpp computes it).
struct DeliveryEstimate {
  double file = 0.0;    // size of the result file
  double memory = 0.0;  // host memory while it is written
};

struct DeviceEstimate {
  std::string name;
  TileMemory tile;      // largest need of the tiles that it computes at a time
  DeviceMemory memory;  // available
};

struct ResourceEstimate {
  double program = 0.0;   // host memory of the program without a study, with its compiled kernels
  double maps = 0.0;      // host memory of the plan, the maps and the trajectories' summaries
  double tiles = 0.0;     // host memory of the tiles at work; of CPU devices their buffers, too
  double delivery = 0.0;  // host memory while the result is written
  double journal = 0.0;   // disk
  double result = 0.0;    // disk
  std::vector<DeviceEstimate> devices;
  double journal_there = 0.0;  // disk, taken already by the journal of an interrupted run
  // Available; empty where the system does not say.
  std::optional<double> memory_left, disk_left;

  // A sum, since memory that tiles free stays with the process.
  double memory() const { return program + maps + tiles + delivery; }
  // Most results are smaller than this bound. Therefore a run that continues a journal does not
  // count the result: if the disk fills up, the journal stays.
  double disk() const {
    return journal_there > 0.0 ? std::max(0.0, journal - journal_there) : journal + result;
  }
};

// journal_path: empty when there is no journal. estimate_of_study knows no engines and no tiles, so
// it leaves them out: a study needs at least this much.
ResourceEstimate estimate_of_study(const Study& study, const DeliveryEstimate& delivery,
                                   const std::string& journal_path);
ResourceEstimate estimate_of_plan(const Plan& plan,
                                  const std::vector<std::unique_ptr<Engine>>& engines,
                                  const DeliveryEstimate& delivery,
                                  const std::string& journal_path);

// Throws InputError, with the numbers and what would help, when memory or disk do not suffice.
void refuse_too_large(const ResourceEstimate& estimate, const std::string& journal_path);

// The memory of the largest tile over the memory of its device; above 1 it does not fit.
double tile_memory_share(const ResourceEstimate& estimate);

// "1.5 GB".
std::string format_bytes(double bytes);

}  // namespace gearsweep
