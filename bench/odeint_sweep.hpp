// The rivals: Boost.odeint's two classical Runge-Kutta steppers on the same equations, native code
// on all cores.
#pragma once

#include <memory>

#include "plan/plan.hpp"

namespace gearsweep::bench {

enum class OdeintStepper {
  runge_kutta4,          // the generic one, what its manual calls rk4
  runge_kutta4_classic,  // written out by hand; what a compiler makes of it is often faster
};

enum class OdeintNumber {
  scalar,  // double or float: one point after the other
  simd,    // std::experimental::native_simd of them: neighbouring points at once
};

class OdeintSweep {
 public:
  virtual ~OdeintSweep() = default;

  // Goes on by so many periods; steps per second of all points together.
  virtual double steps_per_second(std::size_t periods) = 0;
};

// Takes one run of 16 neighbouring points of the tile in `share`, in the study's precision. The
// study is one of gear5 in the formulation `consistent`.
std::unique_ptr<OdeintSweep> make_odeint_sweep(const Plan& plan, const Tile& tile,
                                               std::size_t share, OdeintStepper stepper,
                                               OdeintNumber number);

}  // namespace gearsweep::bench
