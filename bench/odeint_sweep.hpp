// The rival: Boost.odeint's rk4 on the same equations, native code on all cores.
#pragma once

#include <memory>

#include "plan/plan.hpp"

namespace gearsweep::bench {

class OdeintSweep {
 public:
  // Takes every `stride`-th point of the tile, of a study of gear5 in the formulation `consistent`.
  OdeintSweep(const Plan& plan, const Tile& tile, std::size_t stride);
  ~OdeintSweep();

  // Goes on by so many periods; steps per second of all points together.
  double steps_per_second(std::size_t periods);

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace gearsweep::bench
