// The rival that adapts its steps: Boost.odeint's controlled Dormand-Prince method of order 5 on
// gear5, native code on all cores. At a tight tolerance it is also the truth that the others are
// judged by.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "plan/plan.hpp"

namespace gearsweep::bench {

using GearState = std::array<double, 10>;

class DopriSweep {
 public:
  // Points of the plan, whose study is of gear5 with a stiffness that is polynomial in the phase
  // (not `fourier`).
  DopriSweep(const Plan& plan, const std::vector<std::size_t>& points);
  ~DopriSweep();

  struct Run {
    std::vector<GearState> states;  // of each point at the end
    double seconds = 0.0;           // all points together
  };
  // So many periods from the points' own starts. The tolerance is absolute and relative.
  Run run(double tolerance, std::size_t periods) const;

 private:
  struct Point;
  std::vector<Point> points_;
};

}  // namespace gearsweep::bench
