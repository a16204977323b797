// The periodic orbit at one point of a study, and its branch along a parameter.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "orbits/orbit_findings.hpp"
#include "point/place.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// Integration steps of a period, unless more are asked for.
inline constexpr std::size_t kMinOrbitSteps = 2048;

struct OrbitRequest {
  Place place;
  std::optional<FollowedRange>
      range;                 // the parameter's `from` is the start where the place has none
  std::string range_origin;  // what messages call it: "--along"
  std::optional<std::size_t> period;  // in forcing periods; nothing: the smallest that there is
  std::optional<std::size_t> steps;   // of a period; nothing: kMinOrbitSteps or the study's
};

// Throws InputError unless the model has the parameter and it may have the values.
FollowedRange find_range(const Model& model, const std::string& name, double from, double to,
                         const std::string& origin);

// The engine settles the motion, Newton's method on the period map finds the orbit, continuation
// follows it. Of `options`, the first device and stop are used; nothing when stopped. Throws
// InputError, and RunError that says what to try when there is no such orbit.
std::optional<OrbitFindings> find_point_orbit(const Study& whole, const OrbitRequest& request,
                                              const SweepOptions& options);

}  // namespace gearsweep
