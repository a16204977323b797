// Where a run-up and a run-down of the same study part: hysteresis and its jumps.
#pragma once

#include <cstddef>
#include <vector>

#include "result/result_file.hpp"

namespace gearsweep {

// A stretch of an axis where two maps over it differ. Each jump lies between two neighbouring
// values of the axis, so its place is known to half a step.
struct Hysteresis {
  std::size_t first = 0, last = 0;  // places on the axis that differ, both included
  bool jumps_down = false;          // the run-down falls back to the run-up below `first`
  bool jumps_up = false;            // the run-up meets the run-down above `last`
  // Where the jumps are, between the last value on one side and the first on the other; where there
  // is none, the ends of the stretch.
  double from = 0.0, to = 0.0;
};

// up, down: maps of one number for each point over the same values of one axis. Stretches of two
// places or more on which they differ, always to the same side, by more than a fiftieth of the
// range of both, and at an end of which one of them changes by more than half of what they differ
// by, and the other by less: a jump. The same motion looks the same in both; chaos does not, yet
// seldom in this way. Empty when the axes differ.
std::vector<Hysteresis> find_hysteresis(const ResultMap& up, const ResultMap& down);

}  // namespace gearsweep
