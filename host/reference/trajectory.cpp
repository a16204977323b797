#include "reference/trajectory.hpp"

#include "sweep_types.h"

namespace gearsweep {

Trajectory::Trajectory(const Plan& plan, std::size_t point, const Eigen::VectorXd& state)
    : grid_(plan.phase_grid_of(point)),
      row_width_(plan.study().model->phase_coefs.size()),
      signal_count_(plan.study().model->signals.size()),
      point_(plan.study().model->prepare(plan.setting_of(point))),
      state_(state) {}

bool Trajectory::advance_period() { return advance_period(StepCallback()); }

bool Trajectory::advance_period(const StepCallback& each_step) {
  std::size_t row = 0;
  for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
    const double share = grid_.segment_fractions[segment];
    for (std::uint32_t i = 0; i < grid_.segment_steps[segment]; ++i) {
      const Moment before = each_step ? moment(row) : Moment();
      step(row, share * point_->period());
      row += 2;
      if (each_step) each_step(before, moment(row), share);
    }
    row += 1;  // the next segment has its own one-sided coefficients at the break phase
  }
  return in_range();
}

Eigen::VectorXd Trajectory::slope(std::size_t row, const Eigen::VectorXd& state) const {
  Eigen::VectorXd out(state.size());
  point_->rhs(grid_.coefs.data() + row * row_width_, state.data(), out.data());
  return out;
}

Moment Trajectory::moment(std::size_t row) const {
  Moment out;
  out.state = state_;
  out.signals.resize(static_cast<Eigen::Index>(signal_count_));
  point_->signals(grid_.coefs.data() + row * row_width_, state_.data(), out.signals.data());
  return out;
}

void Trajectory::step(std::size_t row, double h) {
  const Eigen::VectorXd k1 = slope(row, state_);
  const Eigen::VectorXd k2 = slope(row + 1, state_ + 0.5 * h * k1);
  const Eigen::VectorXd k3 = slope(row + 1, state_ + 0.5 * h * k2);
  const Eigen::VectorXd k4 = slope(row + 2, state_ + h * k3);
  state_ += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
}

bool Trajectory::in_range() const {
  return state_.allFinite() && state_.cwiseAbs().maxCoeff() < SWEEP_DIVERGED_BEYOND;
}

}  // namespace gearsweep
