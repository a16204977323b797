// What 'gearsweep floquet' found, and how it tells it.
#pragma once

#include <string>

#include "orbits/orbit_findings.hpp"

namespace gearsweep {

// Several lines: the orbit, its multipliers, the nearest bifurcation, those along the range; of
// each number the digits that hold.
std::string describe_floquet(const OrbitFindings& findings);

// The same for scripts, as one JSON object, with every orbit of the branches and all digits
// beside their errors.
std::string floquet_as_json(const OrbitFindings& findings);

}  // namespace gearsweep
