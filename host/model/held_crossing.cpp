// Through the surfaces of a held field: crossings, and resets.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "model/detail/held_sliding.hpp"

namespace gearsweep {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using held::index;
using held::kNear;
using held::kRounding;
using held::RowMajor;

// A flight that takes less of a step than this ends in contact; the second is for a step that has
// been cut often.
constexpr double kShortFlight = 1e-3, kShortOfMany = 2e-2;
constexpr int kManyCuts = 64;

}  // namespace

const std::vector<HeldField::Clearance>& HeldField::clearances(const double* coefs,
                                                               const double* x) {
  clearances_.clear();
  if (slides()) {
    const Sliding along = sliding(coefs, x);
    for (std::size_t i = 0; i < along.surfaces.size(); ++i) {
      const std::size_t k = along.surfaces[i];
      const double share = along.share[index(i)];
      clearances_.push_back({k, share + kNear});
      if (!model_.surfaces[k].resets) clearances_.push_back({k, 1.0 - share + kNear});
    }
  }
  const std::vector<double> levels = values(SurfaceValue::level, coefs, x, 1);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (slides_[k]) continue;
    if (model_.surfaces[k].is_staircase) {
      clearances_.push_back({k, levels[k] - sides_[k]});
      clearances_.push_back({k, sides_[k] + 1.0 - levels[k]});
    } else {
      clearances_.push_back({k, sides_[k] > 0.5 ? levels[k] : -levels[k]});
    }
  }
  if (touches_.empty()) return clearances_;
  const Depths& depths = contacts_.depths(coefs, x);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    clearances_.push_back({sides_.size() + i, touches_[i] ? depths[i] : -depths[i]});
  }
  return clearances_;
}

std::optional<std::size_t> HeldField::left_behind(const double* coefs, const double* x) {
  for (const Clearance& one : clearances(coefs, x)) {
    if (!(one.value >= 0.0)) return one.surface;
  }
  return std::nullopt;
}

void HeldField::pass(std::size_t surface, const double* coefs, int cuts, HeldMotion* motion) {
  cuts_ = cuts;
  double* const x = motion->state.data();
  if (is_contact(surface)) {  // the field bends, and does not jump
    touches_[surface - sides_.size()].flip();
    return;
  }
  if (slides_[surface]) {
    const Sliding along = sliding(coefs, x);
    const auto place = std::ranges::find(along.surfaces, surface) - along.surfaces.begin();
    slides_[surface] = false;
    if (!model_.surfaces[surface].resets) {
      const double at = level_of(surface, sides_[surface]);
      const bool is_above = along.share[place] >= 0.5;
      if (!is_above) sides_[surface] -= 1.0;
      put_beside(surface, at, is_above, coefs, x);
    }
    point_->hold(sides_);
    return;
  }
  const Index states = index(states_);
  VectorXd before(states), behind(states);
  rhs(coefs, x, before.data());
  const double rate = rates(coefs, x, before.data())[surface];
  if (model_.surfaces[surface].resets && sides_[surface] < 0.5 && rate <= 0.0) {
    // It only touches it, and may come to rest there.
    return rebound({surface, rate}, rate, std::numeric_limits<double>::infinity(), coefs, x);
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

// Resets that follow on each other at one moment, each surface once.
struct HeldField::Chain {
  std::vector<Met> met;
  std::vector<double> rates_behind;  // [met]: of their levels, as their own resets left them
  std::vector<bool> in_place;        // [surface]: met, and its level is what it was
  std::vector<bool> changed;         // [surface]: its level was, or what it holds
  const std::vector<bool> rested;    // [surface]: before the first

  bool has(std::size_t surface) const {
    return std::ranges::find(met, surface, &Met::surface) != met.end();
  }
};

// Resets at a surface that is met, and at those that this lifts the state above, or drives it into
// from rest, each once.
void HeldField::reset_from(std::size_t surface, double rate, const double* coefs, double* x,
                           Carried* carried) {
  const Depths depths = contacts_.depths(coefs, x);
  const double level_there = std::fabs(values(SurfaceValue::level, coefs, x, 1)[surface]);
  const std::vector<bool> none(sides_.size());
  Chain chain = {{{surface, rate}}, {}, none, none, slides_};
  for (std::size_t i = 0; i < chain.met.size(); ++i) {
    const Held before = held_at(coefs, x);
    put_behind(chain.met[i].surface, coefs, x, carried);
    const Held now = held_at(coefs, x);
    for (std::size_t k = 0; k < touches_.size(); ++k) {
      const double depth = contacts_.depths(coefs, x)[k];
      if (depth != depths[k]) touches_[k] = depth > 0.0;
    }
    const std::optional<std::size_t> next = next_reset(before, now, coefs, x, &chain);
    if (!next) continue;
    std::vector<double> dx(states_);
    slides_[*next] = false;
    rhs(coefs, x, dx.data());
    chain.met.push_back({*next, std::max(rates(coefs, x, dx.data())[*next], 0.0)});
  }
  met_.insert(met_.end(), chain.met.begin(), chain.met.end());
  has_slid_ = true;  // a reset may leave nothing of a tangent, either
  // What rests may push others into rest.
  for (bool is_new = true; is_new;) {
    is_new = false;
    for (std::size_t i = 0; i < chain.met.size(); ++i) {
      const std::size_t one = chain.met[i].surface;
      if (slides_[one]) continue;
      const double reach = chain.in_place[one] ? std::numeric_limits<double>::infinity()
                           : one == surface    ? level_there
                                               : 0.0;
      rebound(chain.met[i], chain.rates_behind[i], reach, coefs, x);
      is_new = is_new || slides_[one];
    }
  }
}

HeldField::Held HeldField::held_at(const double* coefs, const double* x) const {
  return {values(SurfaceValue::level, coefs, x, 1), values(SurfaceValue::held, coefs, x, 1)};
}

// Where a surface's reset puts the state.
void HeldField::put_behind(std::size_t surface, const double* coefs, double* x,
                           Carried* carried) const {
  const Index states = index(states_);
  const std::vector<double> to = values(SurfaceValue::reset, coefs, x, states_),
                            drifts = values(SurfaceValue::reset_drift, coefs, x, states_),
                            slopes =
                                values(SurfaceValue::reset_gradient, coefs, x, states_ * states_);
  const MatrixXd slope = RowMajor::Map(slopes.data() + surface * states_ * states_, states, states);
  carried->by = (slope * carried->by).eval();
  carried->field =
      (slope * carried->field + VectorXd::Map(drifts.data() + surface * states_, states)).eval();
  std::copy_n(to.begin() + static_cast<std::ptrdiff_t>(surface * states_), states_, x);
}

// Sets the sides behind the last reset. Returns the surface that resets the state next, if any.
std::optional<std::size_t> HeldField::next_reset(const Held& before, const Held& now,
                                                 const double* coefs, const double* x,
                                                 Chain* chain) {
  const std::size_t last = chain->met[chain->rates_behind.size()].surface;
  chain->rates_behind.push_back(now.rates[last]);
  chain->in_place[last] = true;
  std::vector<std::size_t> elsewhere;
  std::optional<std::size_t> next;
  for (std::size_t k = 0; k < now.levels.size(); ++k) {
    const bool stays = now.levels[k] == before.levels[k];
    chain->in_place[k] = chain->in_place[k] && stays;
    if (chain->has(k)) continue;
    const bool resets = model_.surfaces[k].resets;
    const bool is_moved = !stays || (resets && chain->rested[k] && now.rates[k] != before.rates[k]);
    chain->changed[k] = chain->changed[k] || is_moved;
    if (chain->changed[k] && resets && sides_[k] < 0.5 && now.levels[k] > 0.0) {
      if (!next) next = k;
    } else if (is_moved) {
      elsewhere.push_back(k);
    }
  }
  find_sides(elsewhere, now.levels, coefs, x);
  for (const std::size_t k : elsewhere) {
    const bool rests = model_.surfaces[k].resets && chain->rested[k];
    if (rests && now.levels[k] == before.levels[k]) sides_[k] = 0.0;
  }
  point_->hold(sides_);
  for (std::size_t k = 0; k < now.levels.size() && !next; ++k) {
    const bool was_at_rest = model_.surfaces[k].resets && chain->rested[k] && !slides_[k];
    if (!chain->has(k) && chain->changed[k] && was_at_rest && now.rates[k] > 0.0) next = k;
  }
  return next;
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
void HeldField::rebound(const Met& met, double rate_behind, double level_there, const double* coefs,
                        double* x) {
  const std::size_t surface = met.surface;
  std::vector<double> dx(states_);
  rhs(coefs, x, dx.data());
  const double level = values(SurfaceValue::level, coefs, x, 1)[surface];
  const double rate = rates(coefs, x, dx.data())[surface];
  const double push = held_rate(surface, coefs, x, dx.data());
  // The reset leaves the level what it was, but for rounding.
  const double reach = level_there + kNear * step_ * std::max(std::fabs(rate), step_ * push);
  const bool is_at = std::fabs(level) <= 2.0 * reach;
  // Where a reset leaves no speed the rate is rounding. Thrown back, and driven against it again
  // by another surface, it is met anew.
  const bool goes_on = std::min(rate, rate_behind) > kNear * met.rate;
  sides_[surface] = (is_at ? goes_on : level > 0.0) ? 1.0 : 0.0;
  point_->hold(sides_);
  if (!is_at || goes_on) return;
  put_below(surface, coefs, x);
  const double shortest = cuts_ < kManyCuts ? kShortFlight : kShortOfMany;
  if (push <= 0.0 || 2.0 * std::fabs(rate) > shortest * step_ * push) return;
  slides_[surface] = has_slid_ = true;
  put_back(coefs, x);
  bind(coefs, x);
}

void HeldField::put_below(std::size_t surface, const double* coefs, double* x) {
  put_beside(surface, 0.0, false, coefs, x);
}

void HeldField::put_below_all(const double* coefs, double* x) {
  std::vector<std::size_t> resting;
  for (std::size_t k = 0; k < slides_.size(); ++k) {
    if (slides_[k] && model_.surfaces[k].resets) resting.push_back(k);
  }
  if (resting.empty()) return;
  const Index states = index(states_), count = index(resting.size());
  const std::vector<double> levels = values(SurfaceValue::level, coefs, x, 1),
                            all = values(SurfaceValue::level_gradient, coefs, x, states_);
  auto state = VectorXd::Map(x, states);
  MatrixXd gradients(count, states);
  VectorXd down(count);
  for (Index i = 0; i < count; ++i) {
    const std::size_t k = resting[static_cast<std::size_t>(i)];
    gradients.row(i) = VectorXd::Map(all.data() + k * states_, states);
    down[i] = levels[k] + kRounding * gradients.row(i).cwiseAbs().transpose().dot(state.cwiseAbs());
  }
  state -= gradients.transpose() * (gradients * gradients.transpose()).fullPivLu().solve(down);
}

void HeldField::put_beside(std::size_t surface, double at, bool above, const double* coefs,
                           double* x) {
  const Index states = index(states_);
  const std::vector<double> all = values(SurfaceValue::level_gradient, coefs, x, states_);
  const VectorXd gradient = VectorXd::Map(all.data() + surface * states_, states);
  auto state = VectorXd::Map(x, states);
  const double rounding = kRounding * gradient.cwiseProduct(state).cwiseAbs().sum();
  const double down =
      values(SurfaceValue::level, coefs, x, 1)[surface] - at + (above ? -rounding : rounding);
  state -= down / gradient.squaredNorm() * gradient;
}

}  // namespace gearsweep
