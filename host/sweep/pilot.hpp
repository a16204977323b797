// A pilot run that finds the step for integrate.tolerance.
//
// Points of a coarse sub-grid are computed with steps of 0.2, 0.1, 0.05, ... Where a point arrives
// on a periodic orbit of the same period with two steps in a row, their sections and the rms of the
// first state are compared. Differences are relative to the range of the motion, the largest among
// the states of the same unit (an rms that is less, relative to itself): neither offsets nor units
// matter. The longer step is taken when the two agree to the tolerance at 95 % of these points; at
// the others, next to a bifurcation, no step would do. What is left after halving is an estimate of
// the longer step's own error, and a cautious one: the shorter step has some of it, but in the same
// direction.
#pragma once

#include <optional>

#include "sweep/sweep_options.hpp"

namespace gearsweep {

// The study with the step found as its max_step, and what the pilot found. Nothing when stopped.
// Throws InputError when no step does, or no point tells.
struct PilotRun {
  Study study;
  PilotFindings findings;
};
std::optional<PilotRun> find_step(const Study& study, const SweepOptions& options);

// At most `count` of the values, spread evenly, both ends among them.
std::vector<double> thin(const std::vector<double>& values, std::size_t count);

}  // namespace gearsweep
