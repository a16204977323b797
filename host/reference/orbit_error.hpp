// How far an orbit's numbers may be off: by what they change when the steps are twice as long. An
// error of order p is the (2^p - 1)th part of that, a fifteenth where the classical method keeps
// its order; so what is said here is too much rather than too little.
#pragma once

#include <Eigen/Core>

#include "reference/floquet.hpp"

namespace gearsweep {

struct OrbitError {
  double state = 0.0;           // of each component
  Eigen::VectorXd multipliers;  // of their real and imaginary parts, in the orbit's order
  // Whether the motion turns so near to a limit of the backlash that the state's error decides if
  // it touches. The multipliers change there with the root of the distance.
  bool grazing = false;
};

// The error of `orbit`, found with finer steps than those of `coarser`. Infinite when no orbit is
// found near it.
OrbitError error_of(const Orbit& orbit, const PeriodMap& coarser);

}  // namespace gearsweep
