#include "reference/detail/motion_judge.hpp"

#include <algorithm>
#include <cmath>

#include "reference/detail/lyapunov_observables.hpp"
#include "sweep_types.h"

namespace gearsweep {
namespace {

// A section that grows so many times from one half of the record to the other has no bounds.
constexpr double kRunaway = 100.0;

}  // namespace

GrowthWatch::GrowthWatch(Eigen::Index vector, bool has_clock, bool is_clockless)
    : vector_(vector), has_clock_(has_clock), exponent_(make_lyapunov_max(is_clockless)) {}

void GrowthWatch::period(const Eigen::VectorXd& log_stretching, double length) {
  const Eigen::Index vector = std::min(vector_, log_stretching.size() - 1);  // a line has one
  exponent_->period({}, log_stretching.tail(log_stretching.size() - vector), length);
  time_ += length;
}

Growth GrowthWatch::growth(const Window& window) const {
  const std::vector<double> exponent = exponent_->finish(window);
  return {exponent[0] * time_, 3.0 * exponent[1] * time_, has_clock_};
}

int motion_without_period(const StateSequence& states, const Growth& growth, const Window& window) {
  const std::size_t middle = states.last() / 2;
  const double early = states.extent(0, middle), late = states.extent(middle + 1, states.last());
  // In half the record a linear growth takes half of the stretching.
  const double grown = std::min(std::exp(0.4 * growth.log_stretching), kRunaway);
  if (growth.log_stretching > std::max(growth.error, 2.0) && late <= grown * early) {
    return MOTION_chaotic;
  }
  const bool is_long = window.is_last || window.record >= 1000;
  const double whole = states.extent(0, states.last());
  const bool is_steady = whole <= std::max(0.1, 1.25 * std::min(early, late));
  return growth.is_neutral() && is_long && is_steady ? MOTION_quasi_periodic : MOTION_undecided;
}

}  // namespace gearsweep
