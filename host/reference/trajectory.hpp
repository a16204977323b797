// One point's trajectory by the classical Runge-Kutta method in Eigen: the reference engine's own
// integrator, which shares nothing with the kernels but the model's formula and the phase grid.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "plan/plan.hpp"

namespace gearsweep {

// A moment of a trajectory: the state and the model's signals there.
struct Moment {
  Eigen::VectorXd state, signals;
};

// Called for each step with its two ends and its share of the period.
using StepCallback = std::function<void(const Moment& before, const Moment& after, double share)>;

class Trajectory {
 public:
  // `state` at phase 0. The plan must outlive the trajectory.
  Trajectory(const Plan& plan, std::size_t point, const Eigen::VectorXd& state);

  // Advances by one period; false when the state left the range that counts as finite.
  bool advance_period();
  bool advance_period(const StepCallback& each_step);

  const Eigen::VectorXd& state() const { return state_; }
  std::size_t steps_per_period() const { return grid_.steps; }

 private:
  Eigen::VectorXd slope(std::size_t row, const Eigen::VectorXd& state) const;
  Moment moment(std::size_t row) const;
  void step(std::size_t row, double h);
  bool in_range() const;

  PhaseGrid grid_;
  std::size_t row_width_, signal_count_;
  std::unique_ptr<PreparedPoint> point_;
  Eigen::VectorXd state_;
};

}  // namespace gearsweep
