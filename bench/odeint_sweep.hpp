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

class OdeintSweep {
 public:
  // Takes every `stride`-th point of the tile, of a study of gear5 in the formulation `consistent`.
  OdeintSweep(const Plan& plan, const Tile& tile, std::size_t stride, OdeintStepper stepper);
  ~OdeintSweep();

  // Goes on by so many periods; steps per second of all points together.
  double steps_per_second(std::size_t periods);

 private:
  struct Work;
  template <class Stepper>
  void advance_every(std::size_t step, std::size_t first, std::size_t periods);

  std::unique_ptr<Work> work_;
  OdeintStepper stepper_;
};

}  // namespace gearsweep::bench
