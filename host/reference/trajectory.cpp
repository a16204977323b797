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

Trajectory::Bundle Trajectory::slope(std::size_t row, const Bundle& at) const {
  const double* coefs = grid_.coefs.data() + row * row_width_;
  Bundle out{Eigen::VectorXd(at.state.size()), Eigen::MatrixXd()};
  point_->rhs(coefs, at.state.data(), out.state.data());
  if (at.tangents.cols() == 0) return out;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(at.state.size(),
                                                                                  at.state.size());
  point_->jacobian(coefs, at.state.data(), jacobian.data());
  out.tangents = jacobian * at.tangents;
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
  const auto ahead = [this](double length, const Bundle& slope) {
    return Bundle{state_ + length * slope.state, tangents_ + length * slope.tangents};
  };
  const Bundle k1 = slope(row, {state_, tangents_});
  const Bundle k2 = slope(row + 1, ahead(0.5 * h, k1));
  const Bundle k3 = slope(row + 1, ahead(0.5 * h, k2));
  const Bundle k4 = slope(row + 2, ahead(h, k3));
  state_ += h / 6.0 * (k1.state + 2.0 * (k2.state + k3.state) + k4.state);
  tangents_ += h / 6.0 * (k1.tangents + 2.0 * (k2.tangents + k3.tangents) + k4.tangents);
}

bool Trajectory::in_range() const {
  return state_.allFinite() && state_.cwiseAbs().maxCoeff() < SWEEP_DIVERGED_BEYOND;
}

}  // namespace gearsweep
