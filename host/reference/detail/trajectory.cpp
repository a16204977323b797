#include "reference/detail/trajectory.hpp"

#include <cmath>
#include <numbers>

#include "reference/detail/crossing.hpp"
#include "sweep_types.h"

namespace gearsweep {

Trajectory::Trajectory(const Plan& plan, std::size_t point, const Eigen::VectorXd& state)
    : grid_(plan.phase_grid_of(point)),
      row_width_(plan.study().model->phase_coefs.size()),
      signal_count_(plan.study().model->signals.size()),
      angles_(plan.study().model->angles),
      has_contact_(plan.study().model->has_contact),
      has_events_(plan.study().integrate.events && has_contact_),
      point_(plan.study().model->prepare(plan.setting_of(point))),
      state_(state) {
  if (!has_contact_) return;
  deflection_ = plan.study().model->find_signal("deflection");
  backlash_ = plan.study().model->find_signal("backlash");
}

bool Trajectory::advance_period() { return advance_period(StepCallback()); }

bool Trajectory::advance_period(const StepCallback& each_step) {
  std::size_t row = 0;
  for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
    const double share = grid_.segment_fractions[segment];
    std::optional<Moment> earlier;
    for (std::uint32_t i = 0; i < grid_.segment_steps[segment]; ++i) {
      const Eigen::VectorXd start = state_;
      const Eigen::VectorXd middle = step(row, share * point_->period());
      row += 2;
      if (!each_step) continue;
      TrajectoryStep seen = {.before = moment(row - 2, start),
                             .middle = moment(row - 1, middle),
                             .after = moment(row, state_),
                             .share = share};
      seen.is_smooth =
          same_contact(seen.before, seen.middle) && same_contact(seen.middle, seen.after);
      seen.earlier = earlier;
      each_step(seen);
      earlier.reset();
      if (seen.is_smooth) earlier = seen.middle;
    }
    row += 1;  // the next segment has its own one-sided coefficients at the break phase
  }
  const bool is_finite = in_range();
  for (const std::size_t angle : angles_) {
    double& turn = state_[static_cast<Eigen::Index>(angle)];
    turn = std::remainder(turn, 2.0 * std::numbers::pi);
  }
  return is_finite;
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

Moment Trajectory::moment(std::size_t row, const Eigen::VectorXd& state) const {
  Moment out;
  out.state = state;
  out.signals.resize(static_cast<Eigen::Index>(signal_count_));
  point_->signals(grid_.coefs.data() + row * row_width_, state.data(), out.signals.data());
  return out;
}

bool Trajectory::same_contact(const Moment& a, const Moment& b) const {
  if (!has_contact_) return true;
  for (const double flank : {1.0, -1.0}) {
    const auto touches = [&](const Moment& moment) {
      return flank * moment.signals[deflection_] > moment.signals[backlash_];
    };
    if (touches(a) != touches(b)) return false;
  }
  return true;
}

Eigen::VectorXd Trajectory::step(std::size_t row, double h) {
  const Bundle start{state_, tangents_};
  const auto ahead = [&start](double length, const Bundle& slope) {
    return Bundle{start.state + length * slope.state, start.tangents + length * slope.tangents};
  };
  const Bundle k1 = slope(row, start);
  const Bundle at2 = ahead(0.5 * h, k1);
  const Bundle k2 = slope(row + 1, at2);
  const Bundle at3 = ahead(0.5 * h, k2);
  const Bundle k3 = slope(row + 1, at3);
  const Bundle at4 = ahead(h, k3);
  const Bundle k4 = slope(row + 2, at4);
  state_ += h / 6.0 * (k1.state + 2.0 * (k2.state + k3.state) + k4.state);
  tangents_ += h / 6.0 * (k1.tangents + 2.0 * (k2.tangents + k3.tangents) + k4.tangents);
  if (has_events_) correct_crossings(row, h, {start, at2, at3, at4});
  return 0.5 * (start.state + state_) + h / 8.0 * (k1.state - k4.state);
}

void Trajectory::correct_crossings(std::size_t row, double h, const std::array<Bundle, 4>& at) {
  const Eigen::Index states = state_.size();
  const auto coefs = [&](std::size_t i) { return grid_.coefs.data() + (row + i) * row_width_; };
  constexpr std::array<std::size_t, 4> kRow = {0, 1, 1, 2};
  Eigen::Vector4d deflection, backlash;
  for (std::size_t i = 0; i < 4; ++i) {
    Eigen::VectorXd signals(static_cast<Eigen::Index>(signal_count_));
    point_->signals(coefs(kRow[i]), at[i].state.data(), signals.data());
    deflection[static_cast<Eigen::Index>(i)] = signals[deflection_];
    backlash[static_cast<Eigen::Index>(i)] = signals[backlash_];
  }
  for (const double flank : {1.0, -1.0}) {
    const Eigen::Vector4d p = deflection - flank * backlash;
    const auto weights = crossing_weights(p, flank);
    if (!weights) continue;
    Eigen::VectorXd first(states), last(states);
    point_->force_direction(coefs(0), first.data());
    point_->force_direction(coefs(2), last.data());
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(states, states);
    point_->jacobian(coefs(2), state_.data(), jacobian.data());
    const Eigen::VectorXd carry = first - last + h * jacobian * last;
    state_ += h * (last * weights->sum.dot(p) + carry * weights->moment.dot(p));
    for (std::size_t i = 0; i < 4 && tangents_.cols() > 0; ++i) {
      Eigen::RowVectorXd gradient(states);
      point_->penetration_gradient(coefs(kRow[i]), at[i].state.data(), flank, gradient.data());
      const auto k = static_cast<Eigen::Index>(i);
      tangents_ +=
          h * (last * weights->sum[k] + carry * weights->moment[k]) * (gradient * at[i].tangents);
    }
  }
}

bool Trajectory::in_range() const {
  return state_.allFinite() && state_.cwiseAbs().maxCoeff() < SWEEP_DIVERGED_BEYOND;
}

}  // namespace gearsweep
