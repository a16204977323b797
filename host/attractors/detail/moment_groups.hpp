// Which trajectories lie on one attractor, by the moments of their states.
//
// Each moment of a trajectory has an error, and trajectories on one attractor differ by such
// errors. So by one moment after the other, values that lie next to each other are joined, the
// nearest first, as long as the means of two heaps are less apart than several times what makes one
// heap wide: the errors of its values, their spread, or a five-hundredth of what the motion moves
// through. Heaps that stay apart are different attractors. What single values chain from one heap
// to another does not join these. Offsets, units, signs and the order of trajectories do not
// matter.
#pragma once

#include <cstddef>
#include <vector>

#include "attractors/attractor_census.hpp"

namespace gearsweep {

struct MomentGroups {
  std::vector<std::vector<std::size_t>> members;  // [group] trajectories
  // Trajectories that lie no further than their own error from the border between two groups: they
  // went from one to the other during the record, or it is too short for them.
  std::vector<std::size_t> uncertain;
};

// members: of `summaries`, with moments and errors, at one value of all parameters. rounding: what
// any two numbers may differ by.
MomentGroups group_by_moments(const std::vector<TrajectorySummary>& summaries,
                              const std::vector<std::size_t>& members, double rounding);

}  // namespace gearsweep
