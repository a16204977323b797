// Settles one point as a sweep settles all of them: up to the orbit that it is found on, or to the
// end.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/engine.hpp"

namespace gearsweep {

struct SettledPoint {
  std::vector<double> state;  // empty: the point has diverged
  std::size_t settled = 0;    // periods behind the state
  std::size_t settle = 0;     // periods from it to the record
  std::size_t length = 0;     // periods of the orbit that it is on; 0: none was found
};

// initial: [state]. orbit_plan: as of OrbitSearch. Nothing when the callback asked to stop. Throws
// RunError.
std::optional<SettledPoint> settle_point(const Plan& plan, const Plan& orbit_plan,
                                         std::size_t point, const std::vector<double>& initial,
                                         Engine* engine, const RoundCallback& after_round);

}  // namespace gearsweep
