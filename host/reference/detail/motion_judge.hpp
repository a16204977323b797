// What kind of motion it is where none of its states recurs, by kernels/observables/motion.h.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <memory>

#include "reference/detail/observables.hpp"
#include "reference/detail/state_sequence.hpp"

namespace gearsweep {

// What a perturbation grew by in a record.
struct Growth {
  double log_stretching = 0.0, error = 0.0;  // three standard errors
  bool has_clock = false;                    // which neither grows nor decays beside it
  // By more than rounding of a direction that is neither stretched nor shrunk.
  bool grows() const { return log_stretching > std::max(error, 1e-9); }
  bool is_neutral() const {
    if (has_clock && !grows()) return true;
    return std::abs(log_stretching) <= std::max(0.01, std::min(error, 10.0));
  }
};

// Follows one tangent vector: the first, or the one behind it.
class GrowthWatch {
 public:
  GrowthWatch(Eigen::Index vector, bool has_clock, bool is_clockless);
  void period(const Eigen::VectorXd& log_stretching, double length);
  Growth growth(const Window& window) const;

 private:
  Eigen::Index vector_;
  bool has_clock_;
  std::unique_ptr<ReferenceObservable> exponent_;
  double time_ = 0.0;
};

// The values of motion_class (sweep_types.h). states: at the ends of the periods.
int motion_without_period(const StateSequence& states, const Growth& growth, const Window& window);

}  // namespace gearsweep
