// What is known of the periodic orbit at one point of a study, and of its branch along a parameter.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "orbits/branch_switch.hpp"
#include "orbits/continuation.hpp"
#include "orbits/orbit_error.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The range of a parameter along which the orbit is followed; either end may be the larger one.
struct FollowedRange {
  std::size_t parameter = 0;
  double from = 0.0, to = 0.0;
};

struct OrbitFindings {
  Study study;                      // of the one point
  std::vector<std::size_t> placed;  // the parameters that the point was given
  double forcing_period = 0.0;      // in dimensionless time
  Orbit orbit;
  OrbitError error;
  std::optional<FollowedRange> range;
  std::vector<Branch> branches;             // downwards and upwards; none without a range
  std::vector<LeavingBranch> leaving = {};  // what leaves them, as far as it was asked for
  std::size_t generations = 0;              // that were asked for
};

// The bifurcations of branches, by the parameter's value; of findings without what leaves them.
std::vector<LocatedBifurcation> bifurcations_of(const std::vector<Branch>& branches);
std::vector<LocatedBifurcation> bifurcations_of(const OrbitFindings& findings);

// Orbits that stand in one line.
struct OrbitLine {
  std::vector<BranchOrbit> orbits;
  std::size_t start = 0;  // where among them the line was begun
};

// The branches as one line, from the range's `from` to its `to`. The orbit alone where there is no
// range, or no way to begin.
OrbitLine orbits_of(const OrbitFindings& findings);
// The same of a branch that leaves others, which has no orbit at the bifurcation itself.
std::vector<BranchOrbit> orbits_of(const OrbitFindings& findings, const LeavingBranch& leaving);

}  // namespace gearsweep
