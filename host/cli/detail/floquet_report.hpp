// What 'gearsweep floquet' found, and how it tells it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orbits/continuation.hpp"
#include "orbits/orbit_error.hpp"
#include "study/study.hpp"

namespace gearsweep {

// The range of --along, as it was given.
struct FollowedRange {
  std::size_t parameter = 0;
  double from = 0.0, to = 0.0;
};

struct FloquetFindings {
  Study study;  // of one point
  PeriodMap map;
  Orbit orbit;
  OrbitError error;
  std::optional<FollowedRange> range;
  std::vector<Branch> branches;  // downwards and upwards; none without a range
};

// Several lines: the orbit, its multipliers, the nearest bifurcation, those along the range; of
// each number the digits that hold.
std::string describe_floquet(const FloquetFindings& findings);

// The same for scripts, as one JSON object, with every orbit of the branches and all digits
// beside their errors.
std::string floquet_as_json(const FloquetFindings& findings);

}  // namespace gearsweep
