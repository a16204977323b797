// Periodic orbits at places of a plane, found from guesses by Newton's method, many at once.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "borders/orbit_map.hpp"
#include "borders/parameter_plane.hpp"

namespace gearsweep {

struct HeldOrbit {
  PlanePlace place{};
  std::size_t period = 1;        // that brings it back, be it the smallest or not
  Eigen::VectorXd state;         // at phase 0
  Eigen::VectorXd sizes;         // of its states
  Eigen::VectorXcd multipliers;  // of the return map

  bool is_stable() const { return multipliers.cwiseAbs().maxCoeff() < 1.0; }
};

// How far a return is from the state, in sizes; angles by the shorter way around.
Eigen::VectorXd residual_of(const ParameterPlane& plane, const OrbitAnswer& answer,
                            const Eigen::VectorXd& state, const Eigen::VectorXd& sizes);

// Which of these orbits come back sooner than after their period.
std::vector<bool> return_sooner(const ParameterPlane& plane, OrbitMap* map,
                                const std::vector<HeldOrbit>& orbits);

// The orbits near guesses; nothing where Newton's method does not converge, or goes farther than
// `reach` sizes of the states.
std::vector<std::optional<HeldOrbit>> hold_orbits(const ParameterPlane& plane, OrbitMap* map,
                                                  const std::vector<HeldOrbit>& guesses,
                                                  double reach);

}  // namespace gearsweep
