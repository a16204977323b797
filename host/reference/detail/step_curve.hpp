// A quantity inside a step: the polynomial through what it is at the step's start, middle and end,
// and half a step before it where that counts.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace gearsweep {

class StepCurve {
 public:
  StepCurve(double before, double middle, double after, std::optional<double> earlier);

  // t is -1 at the step's start, 0 in its middle and 1 at its end.
  double value(double t) const;
  double slope(double t) const;
  // Where the slope changes sign between the ends; nothing where it does not.
  std::optional<double> extremum() const;
  // A zero between two places whose signs differ.
  double zero(double from, double to) const;

 private:
  double middle_;
  Eigen::VectorXd factors_;  // of t^0, t^1, ..., less the middle's value
};

}  // namespace gearsweep
