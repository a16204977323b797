// Along the surfaces that a motion stays at.
#include "model/detail/held_sliding.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using held::index;
using held::kNear;
using held::kRounding;
using held::RowMajor;

constexpr double kLost = 1.4e-14;  // of a tangent vector

}  // namespace

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
  out.share = edges + out.solve_any(rest - out.gain * edges);
  // Nothing holds it there: it leaves to where both sides lead.
  for (Index i = 0; i < count; ++i) {
    const bool falls =
        rest[i] > 0.0 || model_.surfaces[out.surfaces[static_cast<std::size_t>(i)]].resets;
    if (!std::isfinite(out.share[i])) out.share[i] = falls ? -1.0 : 2.0;
  }
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
  contacts_.slope(coefs, x, touches_, dx);
  if (slides()) VectorXd::Map(dx, index(states_)) = sliding(coefs, x).field();
}

void HeldField::jacobian(const double* coefs, const double* x, double* out) {
  const Index states = index(states_);
  if (!slides()) return contacts_.jacobian(coefs, x, touches_, out);
  const Sliding along = sliding(coefs, x);
  const VectorXd dx = along.field();
  const std::vector<double> below = sides_below();
  const auto with = [&](const std::vector<double>& sides) {
    RowMajor jacobian(states, states);
    point_->hold(sides);
    contacts_.jacobian(coefs, x, touches_, jacobian.data());
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

// What rests on a surface has no other level, either. How much of it there is left when impacts end
// falls with the flights, so that the way back does not matter.
void HeldField::settle(const double* coefs, HeldMotion* motion) {
  if (!slides() || motion->tangents.cols() == 0) return;
  const double* const x = motion->state.data();
  const MatrixXd given = motion->tangents;
  MatrixXd& w = motion->tangents;
  const std::vector<double> levels = values(SurfaceValue::level_gradient, coefs, x, states_);
  MatrixXd across(index(states_), 0);  // of what it rests against
  for (std::size_t k = 0; k < slides_.size(); ++k) {
    if (!slides_[k] || !model_.surfaces[k].resets) continue;
    across.conservativeResize(Eigen::NoChange, across.cols() + 1);
    across.rightCols(1) = VectorXd::Map(levels.data() + k * states_, index(states_));
  }
  if (across.cols() > 0) {
    const Eigen::ColPivHouseholderQR<MatrixXd> decomposed(across);
    const MatrixXd directions = MatrixXd(decomposed.householderQ()).leftCols(decomposed.rank());
    w -= (directions * (directions.transpose() * w)).eval();
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
  put_below_all(coefs, x);
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

}  // namespace gearsweep
