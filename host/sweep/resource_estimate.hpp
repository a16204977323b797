// What a study takes of a machine, before it runs: upper bounds, in bytes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

// What the caller does with the finished maps; result/result_size.hpp knows.
struct DeliveryNeeds {
  double file = 0.0;    // that is written beside the journal
  double memory = 0.0;  // while it is written
};

struct DeviceNeeds {
  std::string name;
  TileMemory tile;      // the most that the tiles take that it computes at a time
  DeviceMemory memory;  // that there is
};

struct StudyNeeds {
  double program = 0.0;  // host memory that it takes without a study, its compiled kernels included
  double maps = 0.0;     // host memory of plan, maps and what is kept of each trajectory
  double tiles = 0.0;    // host memory of the tiles at work, of CPU devices the buffers, too
  double delivery = 0.0;  // host memory while the result is written
  double journal = 0.0;   // disk
  double result = 0.0;    // disk
  std::vector<DeviceNeeds> devices;
  double journal_there = 0.0;  // disk that an interrupted run's journal has already
  // What there is; nothing where it is not known.
  std::optional<double> memory_left, disk_left;

  // What tiles give back to the heap is not given back to the system.
  double memory() const { return program + maps + tiles + delivery; }
  // A result is mostly smaller than it could be. With a journal to continue from, nothing is lost
  // by trying.
  double disk() const {
    return journal_there > 0.0 ? std::max(0.0, journal - journal_there) : journal + result;
  }
};

// journal_path: empty when there is no journal. Of a study alone, without engines and tiles, the
// least that it can take.
StudyNeeds needs_of_study(const Study& study, const DeliveryNeeds& delivery,
                          const std::string& journal_path);
StudyNeeds needs_of_plan(const Plan& plan, const std::vector<std::unique_ptr<Engine>>& engines,
                         const DeliveryNeeds& delivery, const std::string& journal_path);

// Throws InputError, with the numbers and what would help, when memory or disk do not suffice.
void refuse_too_large(const StudyNeeds& needs, const std::string& journal_path);

// How far the heaviest tile is from what its devices have: a share, above 1 when it does not fit.
double strain_of_tile(const StudyNeeds& needs);

// "1.5 GB".
std::string format_bytes(double bytes);

}  // namespace gearsweep
