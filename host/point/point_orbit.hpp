// The periodic orbit or the equilibrium at one point of a study, and its branch along a parameter.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "orbits/orbit_findings.hpp"
#include "point/place.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// Integration steps of a forcing period, or of a cycle from a return to the next, unless more are
// asked for.
inline constexpr std::size_t kMinOrbitSteps = 2048;

struct OrbitRequest {
  Place place;
  std::optional<FollowedRange>
      range;                 // the parameter's `from` is the start where the place has none
  std::string range_origin;  // what messages call it: "--along"
  // In forcing periods, or returns of a cycle; nothing: the smallest that there is.
  std::optional<std::size_t> period;
  std::optional<std::size_t> steps;  // of that; nothing: kMinOrbitSteps or the study's
  bool is_equilibrium = false;       // the one that Newton's method comes to from the start
  // Of a range: what leaves the branches is followed, too, so many generations deep.
  std::size_t generations = 0;
  // As in FollowRequest.
  std::function<void(const Branch& so_far)> each_orbit = {};
};

// Throws InputError unless the model has the parameter and it may have the values.
FollowedRange find_range(const Model& model, const std::string& name, double from, double to,
                         const std::string& origin);

// The engine settles the motion, Newton's method finds the orbit that it is on, continuation
// follows it. Where nothing depends on the phase that is an equilibrium or a cycle. Of `options`,
// the first device and stop are used; nothing when stopped. Throws InputError, and RunError that
// says what to try when there is no such orbit.
std::optional<OrbitFindings> find_point_orbit(const Study& whole, const OrbitRequest& request,
                                              const SweepOptions& options);

}  // namespace gearsweep
