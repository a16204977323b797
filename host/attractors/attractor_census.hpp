// Tells the attractors of a map apart, by the boxes around their sections.
//
// Trajectories with the same parameters reached the same attractor when both boxes agree: those of
// periodic motion to 1e-3 (1e-2 in fp32) of the largest number that any of them has at phase 0, or
// of 1e-3 where all is less; those of other motion, which fill their boxes by chance, to a quarter
// of their extent. An attractor at one value of a parameter is the same as one at the next value
// when both are periodic with the same period, or both are not, each is the other's nearest, and
// their boxes differ by no more than 5 % of the largest number in the map.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "engine/result.hpp"

namespace gearsweep {

// What the census keeps of one trajectory.
struct TrajectorySummary {
  bool is_known = false;  // it ended ok, and its kind of motion is not undecided
  std::size_t motion = 0;
  double period = 0.0, rms = 0.0, peak = 0.0, exponent = 0.0;
  // Impacts in a forcing period; not numbers where nobody asks for them.
  double impacts_drive = std::numeric_limits<double>::quiet_NaN();
  double impacts_back = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> box;  // min of each state at phase 0, then the max
};

struct AttractorList {
  std::vector<Attractor> attractors;  // periodic ones first, then by period, then by their boxes
  std::vector<std::size_t> number;    // [trajectory] of the list, from 1; 0: not known
  std::vector<std::size_t> count;     // [point] different ones among the point's trajectories
};

// summaries: one for each trajectory, in the plan's order.
AttractorList find_attractors(const Study& study, const std::vector<TrajectorySummary>& summaries);

}  // namespace gearsweep
