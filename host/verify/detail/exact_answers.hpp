// Answers that are known in closed form.
#pragma once

#include "model/model.hpp"

namespace gearsweep {

// The sum of all Lyapunov exponents of gear5, for equal gears and 1 < eps < 2: the mean trace of
// its Jacobian, whatever the friction, the backlash law and the impacts.
double gear5_exponent_sum(const ModelSetting& setting);

// x'' + damping x' + stiffness x = amplitude sin(omega t), from x, v at t = 0.
struct LinearOscillator {
  double damping = 0.0, stiffness = 1.0;  // damping^2 < 4 stiffness
  double amplitude = 0.0, omega = 1.0;
  double x = 0.0, v = 0.0;

  struct State {
    double x = 0.0, v = 0.0;
  };
  State at(double t) const;
};

}  // namespace gearsweep
