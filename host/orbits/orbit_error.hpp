// How far an orbit's numbers may be off, from what they change when the steps are twice as long. An
// error of order p is the (2^p - 1)th part of that, a fifteenth where the classical method keeps
// its order; so what is said here is too much rather than too little.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "orbits/floquet.hpp"

namespace gearsweep {

// The error that is told, in such changes. Where an impact lies within its step changes the error's
// factor, so that now and then the longer steps are as good (1.3 changes were the most that was
// seen, of some 900 orbits and bifurcations).
constexpr double kErrorPerChange = 2.0;

struct OrbitError {
  Eigen::VectorXd state;        // of each state
  Eigen::VectorXd multipliers;  // of their real and imaginary parts, in the orbit's order
  double duration = 0.0;        // of a cycle
  // How near the motion turns to a limit of a backlash, where that is nearer than the states are
  // known: their error decides if it touches. The multipliers change there with the root of the
  // distance.
  std::optional<double> graze_distance;

  bool grazing() const { return graze_distance.has_value(); }
};

// The error of `orbit`, found with finer steps than those of `coarser`; a cycle is computed again
// with half of its steps. Infinite when no orbit is found near it. Equilibria know no steps.
OrbitError error_of(const Orbit& orbit, const PeriodMap& coarser);

}  // namespace gearsweep
