// How fast a sweep is and how long it will take, once that is known.
#pragma once

#include <optional>

#include "sweep/sweep.hpp"

namespace gearsweep {

struct Pace {
  double points_per_second = 0.0;
  double seconds_left = 0.0;
};

// Watches one sweep. What is done within a tile tells little: kernels are built when they are first
// needed, and most points stop long before the end that was planned for them, so that the first
// rounds make the rest seem a hundred times as long. So it measures from one finished tile to
// another, and counts down in between.
class PaceMeter {
 public:
  // The pace of the progress that is told now; nothing while there is too little to measure, or
  // when it takes longer than was measured.
  std::optional<Pace> at(const SweepProgress& progress);

 private:
  struct Reading {
    double seconds = 0.0, share = 0.0;
  };
  void measure(const SweepProgress& progress);

  double finished_ = 0.0;  // share of the work, in tiles of this run
  std::optional<Reading> first_;
  Pace pace_;
  std::optional<double> measured_;  // seconds, when pace_ was right
};

}  // namespace gearsweep
