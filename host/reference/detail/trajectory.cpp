#include "reference/detail/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/detail/crossing.hpp"
#include "reference/detail/phase_scan.hpp"

namespace gearsweep {

Trajectory::Trajectory(const Plan& plan, std::size_t point, const Eigen::VectorXd& state)
    : model_(*plan.study().model),
      grid_(scanned_phase_grid(*plan.study().model, plan.setting_of(point), plan.steps_of(point))),
      row_width_(plan.study().model->phase_coefs.size()),
      signal_count_(plan.study().model->signals.size()),
      place_count_(2 * (plan.study().model->contacts.size() + plan.study().model->corners)),
      angles_(plan.study().model->angles),
      contacts_(plan.study().model->contacts),
      limits_(plan.study().model->contact_limits()),
      is_rough_(plan.study().model->is_rough),
      has_events_(plan.study().integrate.events && !limits_.empty()),
      row_at_(plan.study().model->phase_rows(plan.setting_of(point))),
      point_(plan.study().model->prepare(plan.setting_of(point))),
      held_(*plan.study().model, point_.get()),
      held_step_(&held_),
      state_(state) {}

bool Trajectory::advance_period() { return advance_period(StepCallback()); }

bool Trajectory::advance_period(const StepCallback& each_step,
                                const std::function<void()>& on_the_way) {
  constexpr std::uint32_t kFewSteps = 16;
  std::size_t row = 0;
  double phase = 0.0;
  for (std::size_t segment = 0; segment < grid_.segment_steps.size(); ++segment) {
    const double share = grid_.segment_fractions[segment];
    const double inside = phase + 0.5 * share * grid_.segment_steps[segment];
    std::optional<Instant> earlier;
    if (!model_.surfaces.empty()) {
      held_.begin(grid_.coefs.data() + row * row_width_, share * point_->period(), state_.data());
    }
    for (std::uint32_t i = 0; i < grid_.segment_steps[segment]; ++i) {
      if (!model_.surfaces.empty()) {
        step_through_surfaces(moments_of(row, phase + share * i, inside, share), each_step);
        row += 2;
        if (on_the_way && i % kFewSteps == kFewSteps - 1) on_the_way();
        continue;
      }
      const Eigen::VectorXd start = state_;
      const Eigen::VectorXd middle = step(row, share * point_->period());
      row += 2;
      if (on_the_way && i % kFewSteps == kFewSteps - 1) on_the_way();
      if (!each_step) continue;
      TrajectoryStep seen = {.before = moment(row - 2, start),
                             .middle = moment(row - 1, middle),
                             .after = moment(row, state_),
                             .share = share};
      seen.is_smooth = !is_rough_ && same_contact(seen.before, seen.middle) &&
                       same_contact(seen.middle, seen.after);
      seen.earlier = earlier;
      seen.at = [&](double within) {
        return moment_within(moments_of(row - 2, phase + share * i, inside, share), start, within);
      };
      each_step(seen);
      earlier.reset();
      if (seen.is_smooth) earlier = seen.middle;
    }
    row += 1;  // the next segment has its own one-sided coefficients at the break phase
    phase += share * grid_.segment_steps[segment];
  }
  const bool is_within =
      model_.is_within_limits({state_.data(), static_cast<std::size_t>(state_.size())});
  for (const std::size_t angle : angles_) {
    double& turn = state_[static_cast<Eigen::Index>(angle)];
    turn = std::remainder(turn, 2.0 * std::numbers::pi);
  }
  return is_within;
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

Instant Trajectory::moment(std::size_t row, const Eigen::VectorXd& state) const {
  Instant out;
  out.state = state;
  out.signals.resize(static_cast<Eigen::Index>(signal_count_));
  point_->signals(grid_.coefs.data() + row * row_width_, state.data(), out.signals.data());
  return out;
}

Instant Trajectory::moment_within(const StepMoments& moment_at, const Eigen::VectorXd& start,
                                  double share) const {
  const double h = share * moment_at.length * moment_at.period;
  const auto slope_at = [&](double place, const Eigen::VectorXd& state) {
    Eigen::VectorXd out(state.size());
    point_->rhs(moment_at(place).data(), state.data(), out.data());
    return out;
  };
  const Eigen::VectorXd k1 = slope_at(0.0, start);
  const Eigen::VectorXd k2 = slope_at(0.5 * share, start + 0.5 * h * k1);
  const Eigen::VectorXd k3 = slope_at(0.5 * share, start + 0.5 * h * k2);
  const Eigen::VectorXd k4 = slope_at(share, start + h * k3);
  Instant out;
  out.state = start + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
  out.signals.resize(static_cast<Eigen::Index>(signal_count_));
  point_->signals(moment_at(share).data(), out.state.data(), out.signals.data());
  return out;
}

double Trajectory::beyond(const ContactLimit& limit, std::size_t row,
                          const Eigen::VectorXd& state) const {
  Eigen::VectorXd places(static_cast<Eigen::Index>(place_count_));
  point_->contact_places(grid_.coefs.data() + row * row_width_, state.data(), places.data());
  const auto deflection = static_cast<Eigen::Index>(2 * limit.contact);
  return places[deflection] - limit.flank * places[deflection + 1];
}

// Compares the contacts that the model shows; corners are none of them.
bool Trajectory::same_contact(const Instant& a, const Instant& b) const {
  return std::ranges::all_of(contacts_, [&](const ContactInfo& contact) {
    const auto touches = [&](const Instant& moment, double flank) {
      const double deflection = moment.signals[static_cast<Eigen::Index>(contact.deflection)];
      return flank * deflection > moment.signals[static_cast<Eigen::Index>(contact.backlash)];
    };
    return touches(a, 1.0) == touches(b, 1.0) &&
           (contact.is_one_sided || touches(a, -1.0) == touches(b, -1.0));
  });
}

StepMoments Trajectory::moments_of(std::size_t row, double phase, double inside,
                                   double share) const {
  return {&row_at_,
          row_width_,
          phase,
          share,
          inside,
          point_->period(),
          grid_.coefs.data() + row * row_width_};
}

Instant Trajectory::held_instant(const std::vector<double>& coefs, const Eigen::VectorXd& state) {
  Instant out{state, Eigen::VectorXd(static_cast<Eigen::Index>(signal_count_))};
  held_.signals(coefs.data(), state.data(), out.signals.data());
  return out;
}

void Trajectory::step_through_surfaces(const StepMoments& moment, const StepCallback& seen) {
  const auto tell = [&](double from, double to, const Bundle& before, const Bundle& after) {
    if (!seen) return;
    const auto at = [&](double share_of_part) {
      const double end = from + share_of_part * (to - from);
      Bundle there{before.state, Eigen::MatrixXd(before.state.size(), 0)};
      held_step_.carry(moment, from, end, &there);
      return held_instant(moment(end), there.state);
    };
    TrajectoryStep step = {.before = held_instant(moment(from), before.state),
                           .middle = at(0.5),
                           .after = held_instant(moment(to), after.state),
                           .share = (to - from) * moment.length,
                           .ends_step = to == 1.0};
    step.is_smooth = !is_rough_ && same_contact(step.before, step.middle) &&
                     same_contact(step.middle, step.after);
    step.at = at;
    step.stays = held_.slides();
    step.met = held_.take_met();
    seen(step);
  };
  Bundle motion{state_, tangents_};
  held_step_.take(moment, &motion, tell);
  if (!seen) held_.take_met();  // nobody asks for it
  state_ = motion.state;
  tangents_ = motion.tangents;
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
  for (const ContactLimit& limit : limits_) correct_crossing(limit, row, h, at);
}

void Trajectory::correct_crossing(const ContactLimit& limit, std::size_t row, double h,
                                  const std::array<Bundle, 4>& at) {
  using Row = Eigen::RowVectorXd;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Index states = state_.size();
  constexpr std::array<std::size_t, 4> kRow = {0, 1, 1, 2};
  const auto coefs = [&](std::size_t i) { return grid_.coefs.data() + (row + i) * row_width_; };
  Eigen::Vector4d seen;
  for (std::size_t i = 0; i < 4; ++i) {
    seen[static_cast<Eigen::Index>(i)] = beyond(limit, row + kRow[i], at[i].state);
  }
  Eigen::VectorXd first(states), last(states);
  point_->force_direction(limit.contact, coefs(0), at[0].state.data(), first.data());
  point_->force_direction(limit.contact, coefs(2), state_.data(), last.data());
  Row gradient(states);
  point_->penetration_gradient(limit, coefs(2), state_.data(), gradient.data());
  const Eigen::Matrix4d clean = crossing_feedback(seen, limit.flank, h * gradient.dot(last));
  const Eigen::Vector4d p = clean * seen;
  const auto weights = crossing_weights(seen, p, limit.flank);
  if (!weights) return;
  Matrix jacobian(states, states);
  point_->jacobian(coefs(2), state_.data(), jacobian.data());
  const Eigen::VectorXd carry = first - last + h * jacobian * last;
  const double sum = weights->sum.dot(p), moment = weights->moment.dot(p);
  Matrix first_slope(states, states), last_slope(states, states);
  point_->force_direction_slope(limit.contact, coefs(0), at[0].state.data(), first_slope.data());
  point_->force_direction_slope(limit.contact, coefs(2), state_.data(), last_slope.data());
  state_ += h * (last * sum + carry * moment);
  if (tangents_.cols() == 0) return;
  Matrix p_by_tangents(4, tangents_.cols());
  for (std::size_t i = 0; i < 4; ++i) {
    point_->penetration_gradient(limit, coefs(kRow[i]), at[i].state.data(), gradient.data());
    p_by_tangents.row(static_cast<Eigen::Index>(i)) = gradient * at[i].tangents;
  }
  p_by_tangents = clean * p_by_tangents;
  tangents_ +=
      h * (last_slope * sum + (first_slope - last_slope) * moment) * tangents_ +
      h * (last * weights->sum.transpose() + carry * weights->moment.transpose()) * p_by_tangents;
}

}  // namespace gearsweep
