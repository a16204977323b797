// Tells the attractors of a map apart, by where trajectories are.
//
// The place of a periodic motion is the box around its sections, that of other motion the means and
// standard deviations of its states at phase 0. An autonomous model has no phase: there the place
// of each motion is what its states have over all of it. Trajectories with the same parameters
// reached the same attractor when both places agree: those of periodic motion, and those at rest,
// to 1e-3 (1e-2 in fp32) of the largest number that any of them has, or of 1e-3 where all is less;
// all other to within the errors of their moments (detail/moment_groups.hpp). An attractor at one
// value of a parameter is the same as one at the next value when both rest, or both are periodic
// with the same period, or neither does either, each is the other's nearest, and their places
// differ by no more than 5 % of the largest number in the map.
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
  // Min of each state at phase 0, then the max; or where there are errors the mean of each state,
  // then the standard deviation.
  std::vector<double> place;
  std::vector<double> errors;  // of each number of the place
};

struct AttractorList {
  std::vector<Attractor> attractors;  // rest, periodic ones by period, others; then by their places
  std::vector<std::size_t> number;    // [trajectory] of the list, from 1; 0: not known
  std::vector<std::size_t> count;     // [point] different ones among the point's trajectories
  std::size_t uncertain = 0;          // trajectories between two attractors, that may be of either
};

// summaries: one for each trajectory, in the plan's order.
AttractorList find_attractors(const Study& study, const std::vector<TrajectorySummary>& summaries);

}  // namespace gearsweep
