#include "model/held_field.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr double kNear = 1e-9;  // of what a level changes in a step
// The same where the state is reset: a motion that has just met it must not count as beyond it.
constexpr double kOn = 1e-6;
// Of a step: a flight that is shorter ends in contact.
constexpr double kShortFlight = 1e-3;
constexpr double kLost = 1.4e-14;      // of a tangent vector
constexpr double kRounding = 1.8e-15;  // 8 roundings

Index index(std::size_t i) { return static_cast<Index>(i); }

}  // namespace

// The field without what keeps the motion at its surfaces, what that adds for each surface, and how
// much of it there must be.
struct HeldField::Sliding {
  std::vector<std::size_t> surfaces;
  VectorXd base, share;
  MatrixXd turn, gain;  // [state][surface], [held value][surface]
  RowMajor gradients;   // of what is held
  // The share of a jump that holds what a surface holds that the motion rests against, as dry
  // friction does of a mass at a wall. What each of them does cannot be told; the wall lets the
  // mass go on one side alone, and the jump is on that side.
  std::vector<std::optional<double>> bound;

  VectorXd field() const { return base + turn * share; }
  // What gain times the result is, row by row, but for what is bound: that is 0.
  MatrixXd solve(MatrixXd wanted) const {
    MatrixXd left = gain;
    for (std::size_t i = 0; i < bound.size(); ++i) {
      if (!bound[i]) continue;
      left.row(index(i)) = MatrixXd::Identity(left.rows(), left.cols()).row(index(i));
      wanted.row(index(i)).setZero();
    }
    return left.partialPivLu().solve(wanted);
  }
};

HeldField::HeldField(const Model& model, PreparedPoint* point)
    : model_(model),
      point_(point),
      states_(model.whole == nullptr ? model.states.size() : model.whole->states.size()),
      sides_(model.surfaces.size()),
      slides_(model.surfaces.size()),
      limits_(model.contact_limits()) {}

std::vector<double> HeldField::values(SurfaceValue value, const double* coefs, const double* x,
                                      std::size_t each) const {
  std::vector<double> out(sides_.size() * each);
  point_->of_surfaces(value, coefs, x, out.data());
  return out;
}

std::vector<bool> HeldField::touching(const double* coefs, const double* x) const {
  std::vector<double> places(2 * (model_.contacts.size() + model_.corners));
  if (!places.empty()) point_->contact_places(coefs, x, places.data());
  std::vector<bool> out;
  for (const ContactLimit& limit : limits_) {
    const double* const place = &places[2 * limit.contact];
    out.push_back(limit.flank * place[0] > place[1]);
  }
  return out;
}

std::vector<double> HeldField::rates(const double* coefs, const double* x, const double* dx) const {
  std::vector<double> out = values(SurfaceValue::level_drift, coefs, x, 1);
  const std::vector<double> gradients = values(SurfaceValue::level_gradient, coefs, x, states_);
  for (std::size_t k = 0; k < out.size(); ++k) {
    for (std::size_t i = 0; i < states_; ++i) out[k] += gradients[k * states_ + i] * dx[i];
  }
  return out;
}

std::vector<double> HeldField::field_with(const std::vector<double>& sides, const double* coefs,
                                          const double* x) {
  std::vector<double> dx(states_);
  point_->hold(sides);
  point_->rhs(coefs, x, dx.data());
  point_->hold(sides_);
  return dx;
}

double HeldField::held_rate(std::size_t surface, const double* coefs, const double* x,
                            const double* dx) const {
  const std::vector<double> gradients = values(SurfaceValue::held_gradient, coefs, x, states_);
  double rate = values(SurfaceValue::held_drift, coefs, x, 1)[surface];
  for (std::size_t i = 0; i < states_; ++i) rate += gradients[surface * states_ + i] * dx[i];
  return rate;
}

void HeldField::begin(const double* coefs, double step, const double* x) {
  step_ = step;
  std::vector<std::size_t> all(sides_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  find_sides(all, values(SurfaceValue::level, coefs, x, 1), coefs, x);
  touches_ = touching(coefs, x);
}

void HeldField::find_sides(const std::vector<std::size_t>& surfaces,
                           const std::vector<double>& levels, const double* coefs,
                           const double* x) {
  for (const std::size_t k : surfaces) {
    const double level = levels[k];
    sides_[k] = model_.surfaces[k].is_staircase ? std::floor(level) : level > 0.0 ? 1.0 : 0.0;
    slides_[k] = false;
  }
  for (const std::size_t k : surfaces) begin_at(k, levels[k], coefs, x);
  has_slid_ = has_slid_ || slides();
  point_->hold(sides_);
  if (rests()) bind(coefs, x);
}

void HeldField::begin_at(std::size_t k, double level, const double* coefs, const double* x) {
  if (model_.surfaces[k].resets) {
    const std::vector<double> dx = field_with(sides_, coefs, x);
    const double rate = rates(coefs, x, dx.data())[k], push = held_rate(k, coefs, x, dx.data());
    const double reach = kOn * step_ * std::max(std::fabs(rate), step_ * std::fabs(push));
    if (std::fabs(level) > reach) return;
    sides_[k] = 0.0;
    slides_[k] = push > 0.0 && std::fabs(rate) <= kNear * step_ * push;
    return;
  }
  const double above = model_.surfaces[k].is_staircase ? std::rint(level) : 1.0;
  std::vector<double> sides = sides_;
  const auto rate_on = [&](double side) {
    sides[k] = side;
    return rates(coefs, x, field_with(sides, coefs, x).data())[k];
  };
  const double up = rate_on(above), down = rate_on(above - 1.0);
  const double reach = kNear * step_ * std::max(std::fabs(up), std::fabs(down));
  if (std::fabs(level - level_of(k, above)) > reach) return;
  slides_[k] = up < 0.0 && down > 0.0;
  sides_[k] = up < 0.0 && !slides_[k] ? above - 1.0 : above;
}

bool HeldField::slides() const { return std::ranges::find(slides_, true) != slides_.end(); }

double HeldField::level_of(std::size_t surface, double above) const {
  return model_.surfaces[surface].is_staircase ? above : 0.0;
}

std::vector<double> HeldField::sides_below() const {
  std::vector<double> sides = sides_;
  for (std::size_t k = 0; k < sides.size(); ++k) {
    if (slides_[k] && !model_.surfaces[k].resets) sides[k] -= 1.0;
  }
  return sides;
}

HeldField::Sliding HeldField::sliding(const double* coefs, const double* x) {
  Sliding out;
  for (std::size_t k = 0; k < slides_.size(); ++k) {
    if (slides_[k]) out.surfaces.push_back(k);
  }
  const Index states = index(states_), count = index(out.surfaces.size());
  const std::vector<double> gradients = values(SurfaceValue::held_gradient, coefs, x, states_),
                            turns = values(SurfaceValue::turn, coefs, x, states_),
                            drifts = values(SurfaceValue::held_drift, coefs, x, 1);
  const std::vector<double> below = sides_below(), base = field_with(below, coefs, x);
  out.base = VectorXd::Map(base.data(), states);
  out.turn.resize(states, count);
  out.gradients.resize(count, states);
  VectorXd rest(count);
  for (Index i = 0; i < count; ++i) {
    const std::size_t k = out.surfaces[static_cast<std::size_t>(i)];
    if (model_.surfaces[k].resets) {
      out.turn.col(i) = VectorXd::Map(turns.data() + k * states_, states);
    } else {
      std::vector<double> sides = below;
      sides[k] = sides_[k];
      const std::vector<double> above = field_with(sides, coefs, x);
      out.turn.col(i) = VectorXd::Map(above.data(), states) - out.base;
    }
    out.gradients.row(i) = VectorXd::Map(gradients.data() + k * states_, states).transpose();
    rest[i] = -drifts[k] - out.gradients.row(i).dot(out.base);
  }
  out.gain = out.gradients * out.turn;
  find_bound(&out);
  VectorXd edges = VectorXd::Zero(count);
  for (Index i = 0; i < count; ++i) edges[i] = out.bound[static_cast<std::size_t>(i)].value_or(0.0);
  out.share = edges + out.solve(rest - out.gain * edges);
  return out;
}

void HeldField::find_bound(Sliding* sliding) const {
  constexpr double kSame = 1e-9;
  const MatrixXd& gain = sliding->gain;
  const auto resets = [&](Index i) {
    return model_.surfaces[sliding->surfaces[static_cast<std::size_t>(i)]].resets;
  };
  sliding->bound.assign(sliding->surfaces.size(), std::nullopt);
  for (Index jump = 0; jump < gain.rows(); ++jump) {
    for (Index wall = 0; wall < gain.rows() && !resets(jump); ++wall) {
      if (!resets(wall)) continue;
      const double both = gain(jump, jump) * gain(wall, wall);
      if (both == 0.0 ||
          std::fabs(both - gain(jump, wall) * gain(wall, jump)) > kSame * std::fabs(both)) {
        continue;
      }
      // Away from the wall its rate falls.
      sliding->bound[static_cast<std::size_t>(jump)] =
          gain(jump, wall) / gain(wall, wall) > 0.0 ? 0.0 : 1.0;
    }
  }
}

// Where the motion rests against a surface, the jumps that it is at and that hold the same.
void HeldField::bind(const double* coefs, const double* x) {
  const std::vector<double> levels = values(SurfaceValue::level, coefs, x, 1);
  for (std::size_t k = 0; k < slides_.size(); ++k) {
    if (model_.surfaces[k].resets) continue;
    const bool slid = slides_[k];
    const double side = sides_[k];
    sides_[k] = model_.surfaces[k].is_staircase ? std::rint(levels[k]) : 1.0;
    slides_[k] = true;
    const Sliding along = sliding(coefs, x);
    const auto place = std::ranges::find(along.surfaces, k) - along.surfaces.begin();
    const double reach = kNear * step_ * std::fabs(along.gain(place, place));
    if (along.bound[static_cast<std::size_t>(place)] &&
        std::fabs(levels[k] - level_of(k, sides_[k])) <= reach) {
      continue;
    }
    slides_[k] = slid;
    sides_[k] = side;
  }
  point_->hold(sides_);
}

bool HeldField::rests() const {
  for (std::size_t k = 0; k < slides_.size(); ++k) {
    if (slides_[k] && model_.surfaces[k].resets) return true;
  }
  return false;
}

void HeldField::rhs(const double* coefs, const double* x, double* dx) {
  point_->rhs(coefs, x, dx);
  if (slides()) VectorXd::Map(dx, index(states_)) = sliding(coefs, x).field();
}

void HeldField::jacobian(const double* coefs, const double* x, double* out) {
  const Index states = index(states_);
  if (!slides()) return point_->jacobian(coefs, x, out);
  const Sliding along = sliding(coefs, x);
  const VectorXd dx = along.field();
  const std::vector<double> below = sides_below();
  const auto with = [&](const std::vector<double>& sides) {
    RowMajor jacobian(states, states);
    point_->hold(sides);
    point_->jacobian(coefs, x, jacobian.data());
    point_->hold(sides_);
    return jacobian;
  };
  const RowMajor base = with(below);
  RowMajor mixed = base;
  // The rate of what is held changes with the state at a field that stays, too.
  const std::vector<double> bends = values(SurfaceValue::held_bend, coefs, x, states_ * states_),
                            drifting = values(SurfaceValue::held_drift_gradient, coefs, x, states_);
  RowMajor shift(along.share.size(), states);
  for (Index i = 0; i < along.share.size(); ++i) {
    const std::size_t k = along.surfaces[static_cast<std::size_t>(i)];
    if (!model_.surfaces[k].resets) {
      std::vector<double> sides = below;
      sides[k] = sides_[k];
      mixed += along.share[i] * (with(sides) - base);
    }
    const auto bend = RowMajor::Map(bends.data() + k * states_ * states_, states, states);
    shift.row(i) =
        dx.transpose() * bend + VectorXd::Map(drifting.data() + k * states_, states).transpose();
  }
  shift += along.gradients * mixed;
  RowMajor::Map(out, states, states) = mixed - along.turn * along.solve(shift);
}

void HeldField::signals(const double* coefs, const double* x, double* out) {
  std::vector<double> shown = sides_;
  if (slides()) {
    const Sliding along = sliding(coefs, x);
    for (std::size_t i = 0; i < along.surfaces.size(); ++i) {
      const std::size_t k = along.surfaces[i];
      if (!model_.surfaces[k].resets) shown[k] += along.share[index(i)] - 1.0;
    }
  }
  point_->hold(shown);
  point_->signals(coefs, x, out);
  point_->hold(sides_);
}

std::optional<std::size_t> HeldField::left_behind(const double* coefs, const double* x) {
  if (slides()) {
    const Sliding along = sliding(coefs, x);
    for (std::size_t i = 0; i < along.surfaces.size(); ++i) {
      const double share = along.share[index(i)];
      const bool is_bounded = !model_.surfaces[along.surfaces[i]].resets;
      if (share < -kNear || (is_bounded && share > 1.0 + kNear)) return along.surfaces[i];
    }
  }
  const std::vector<double> at = values(SurfaceValue::level, coefs, x, 1);
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (slides_[k]) continue;
    const bool stays = model_.surfaces[k].is_staircase ? std::floor(at[k]) == sides_[k]
                       : sides_[k] > 0.5               ? at[k] >= 0.0
                                                       : at[k] <= 0.0;
    if (!stays) return k;
  }
  const std::vector<bool> touch = touching(coefs, x);
  const auto changed = std::ranges::mismatch(touch, touches_).in1;
  if (changed == touch.end()) return std::nullopt;
  return sides_.size() + static_cast<std::size_t>(changed - touch.begin());
}

void HeldField::pass(std::size_t surface, const double* coefs, HeldMotion* motion) {
  double* const x = motion->state.data();
  if (surface >= sides_.size()) {  // the field bends, and does not jump
    touches_[surface - sides_.size()].flip();
    return;
  }
  if (slides_[surface]) {
    const Sliding along = sliding(coefs, x);
    const auto place = std::ranges::find(along.surfaces, surface) - along.surfaces.begin();
    if (!model_.surfaces[surface].resets && along.share[place] < 0.5) sides_[surface] -= 1.0;
    slides_[surface] = false;
    point_->hold(sides_);
    return;
  }
  const Index states = index(states_);
  VectorXd before(states), behind(states);
  rhs(coefs, x, before.data());
  const double rate = rates(coefs, x, before.data())[surface];
  if (model_.surfaces[surface].resets && sides_[surface] < 0.5 && rate <= 0.0) {
    return put_below(surface, coefs, x);  // it only touches it
  }
  const VectorXd delays =
      VectorXd::Map(
          values(SurfaceValue::level_gradient, coefs, x, states_).data() + surface * states_,
          states) /
      rate;
  Carried carried{MatrixXd::Identity(states, states), before};
  if (model_.surfaces[surface].resets && sides_[surface] < 0.5) {
    reset_from(surface, rate, coefs, x, &carried);
  } else {
    cross(surface, coefs, x);
  }
  rhs(coefs, x, behind.data());
  MatrixXd& w = motion->tangents;
  if (rate != 0.0 && w.cols() > 0) {
    w = (carried.by * w + (behind - carried.field) * (delays.transpose() * w)).eval();
  }
}

// Resets at a surface that is met, and at those that this lifts the state above, each once.
void HeldField::reset_from(std::size_t surface, double rate, const double* coefs, double* x,
                           Carried* carried) {
  const Index states = index(states_);
  const double level_there = std::fabs(values(SurfaceValue::level, coefs, x, 1)[surface]);
  std::vector<Met> met = {{surface, rate}};
  for (std::size_t i = 0; i < met.size(); ++i) {
    const std::size_t one = met[i].surface;
    const std::vector<double> to = values(SurfaceValue::reset, coefs, x, states_),
                              drifts = values(SurfaceValue::reset_drift, coefs, x, states_),
                              slopes =
                                  values(SurfaceValue::reset_gradient, coefs, x, states_ * states_),
                              before = values(SurfaceValue::level, coefs, x, 1);
    const MatrixXd slope = RowMajor::Map(slopes.data() + one * states_ * states_, states, states);
    carried->by = (slope * carried->by).eval();
    carried->field =
        (slope * carried->field + VectorXd::Map(drifts.data() + one * states_, states)).eval();
    std::copy_n(to.begin() + static_cast<std::ptrdiff_t>(one * states_), states_, x);
    const std::vector<double> levels = values(SurfaceValue::level, coefs, x, 1);
    std::vector<std::size_t> elsewhere;
    std::optional<std::size_t> lifted_above;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (std::ranges::find(met, k, &Met::surface) != met.end()) continue;
      if (model_.surfaces[k].resets && sides_[k] < 0.5 && levels[k] > 0.0) {
        if (!lifted_above) lifted_above = k;
      } else if (levels[k] != before[k]) {
        elsewhere.push_back(k);
      }
    }
    find_sides(elsewhere, levels, coefs, x);
    if (!lifted_above) continue;
    std::vector<double> dx(states_);
    slides_[*lifted_above] = false;
    rhs(coefs, x, dx.data());
    met.push_back({*lifted_above, std::max(rates(coefs, x, dx.data())[*lifted_above], 0.0)});
  }
  for (const Met& one : met) {
    rebound(one, one.surface == surface ? level_there : 0.0, coefs, x);
    met_.push_back(one);
  }
}

// The other side of a jump, or along it.
void HeldField::cross(std::size_t surface, const double* coefs, const double* x) {
  const double level = values(SurfaceValue::level, coefs, x, 1)[surface];
  const bool is_up =
      model_.surfaces[surface].is_staircase ? level > sides_[surface] + 0.5 : sides_[surface] < 0.5;
  sides_[surface] += is_up ? 1.0 : -1.0;
  point_->hold(sides_);
  if (model_.surfaces[surface].resets) return;
  std::vector<double> behind(states_);
  rhs(coefs, x, behind.data());
  if (rates(coefs, x, behind.data())[surface] * (is_up ? 1.0 : -1.0) < 0.0) {
    if (!is_up) sides_[surface] += 1.0;
    slides_[surface] = has_slid_ = true;
    point_->hold(sides_);
  }
}

// Behind a reset: back, on through the surface, to where the reset put it, or at rest on it, where
// the flight to the next impact would be too short to count.
void HeldField::rebound(const Met& met, double level_there, const double* coefs, double* x) {
  const std::size_t surface = met.surface;
  std::vector<double> dx(states_);
  rhs(coefs, x, dx.data());
  const double level = values(SurfaceValue::level, coefs, x, 1)[surface];
  const double rate = rates(coefs, x, dx.data())[surface];
  const double push = held_rate(surface, coefs, x, dx.data());
  // The reset leaves the level what it was, but for rounding.
  const double reach = level_there + kNear * step_ * std::max(std::fabs(rate), step_ * push);
  const bool is_at = std::fabs(level) <= 2.0 * reach;
  // Of a reset that leaves no speed the rate is rounding.
  const bool goes_on = rate > kNear * met.rate;
  sides_[surface] = (is_at ? goes_on : level > 0.0) ? 1.0 : 0.0;
  point_->hold(sides_);
  if (!is_at || goes_on) return;
  put_below(surface, coefs, x);
  if (push <= 0.0 || 2.0 * std::fabs(rate) > kShortFlight * step_ * push) return;
  slides_[surface] = has_slid_ = true;
  put_back(coefs, x);
  bind(coefs, x);
}

// What rests on a surface has no other level, either. How much of it there is left when impacts end
// falls with the flights, so that the way back does not matter.
void HeldField::settle(const double* coefs, HeldMotion* motion) {
  if (!slides() || motion->tangents.cols() == 0) return;
  const double* const x = motion->state.data();
  const MatrixXd given = motion->tangents;
  MatrixXd& w = motion->tangents;
  const std::vector<double> levels = values(SurfaceValue::level_gradient, coefs, x, states_);
  for (std::size_t k = 0; k < slides_.size(); ++k) {
    if (!slides_[k] || !model_.surfaces[k].resets) continue;
    const VectorXd level = VectorXd::Map(levels.data() + k * states_, index(states_));
    w -= (level * (level.transpose() * w) / level.squaredNorm()).eval();
  }
  const Sliding along = sliding(coefs, x);
  w -= (along.turn * along.solve(along.gradients * w)).eval();
  // What is left of one that is lost whole is rounding.
  for (Index j = 0; j < w.cols(); ++j) {
    if (w.col(j).cwiseAbs().maxCoeff() < kLost * given.col(j).cwiseAbs().maxCoeff()) {
      w.col(j).setZero();
    }
  }
}

void HeldField::put_back(const double* coefs, double* x) {
  if (!slides()) return;
  const Index states = index(states_);
  auto state = VectorXd::Map(x, states);
  for (std::size_t k = 0; k < slides_.size(); ++k) {
    if (slides_[k] && model_.surfaces[k].resets) put_below(k, coefs, x);
  }
  const Sliding along = sliding(coefs, x);
  const std::vector<double> at = values(SurfaceValue::held, coefs, x, 1);
  VectorXd off(along.share.size());
  for (Index i = 0; i < off.size(); ++i) {
    const std::size_t k = along.surfaces[static_cast<std::size_t>(i)];
    off[i] = level_of(k, sides_[k]) - at[k];
  }
  state += along.turn * along.solve(off);
  // What sticks is at rest: what is left of a velocity is rounding of what a step adds to it.
  for (Index i = 0; i < states; ++i) {
    double added = std::fabs(along.base[i]);
    bool is_held = false;
    for (Index j = 0; j < off.size(); ++j) {
      is_held = is_held || along.turn(i, j) != 0.0;
      const bool jumps = !model_.surfaces[along.surfaces[static_cast<std::size_t>(j)]].resets;
      if (jumps) added += std::fabs(along.turn(i, j));
    }
    if (is_held && std::fabs(state[i]) <= kRounding * step_ * added) state[i] = 0.0;
  }
}

// To just below a surface, so that by rounding it does not count as beyond it.
void HeldField::put_below(std::size_t surface, const double* coefs, double* x) {
  const Index states = index(states_);
  const std::vector<double> all = values(SurfaceValue::level_gradient, coefs, x, states_);
  const VectorXd gradient = VectorXd::Map(all.data() + surface * states_, states);
  auto state = VectorXd::Map(x, states);
  const double down = values(SurfaceValue::level, coefs, x, 1)[surface] +
                      kRounding * gradient.cwiseProduct(state).cwiseAbs().sum();
  state -= down / gradient.squaredNorm() * gradient;
}

bool HeldField::take_slid() {
  const bool slid = has_slid_;
  has_slid_ = false;
  return slid;
}

}  // namespace gearsweep
