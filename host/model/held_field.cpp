#include "model/held_field.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/detail/held_sliding.hpp"

namespace gearsweep {
namespace {

using held::kNear;

// The same where the state is reset: a motion that has just met it must not count as beyond it.
constexpr double kOn = 1e-6;

}  // namespace

HeldField::HeldField(const Model& model, PreparedPoint* point)
    : model_(model),
      point_(point),
      states_(model.full().states.size()),
      sides_(model.surfaces.size()),
      slides_(model.surfaces.size()),
      contacts_(model, *point) {}

std::vector<double> HeldField::values(SurfaceValue value, const double* coefs, const double* x,
                                      std::size_t each) const {
  std::vector<double> out(sides_.size() * each);
  if (out.empty()) return out;
  point_->of_surfaces(value, coefs, x, out.data());
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

HeldField::Levels HeldField::levels(const double* coefs, const double* x) {
  std::vector<double> dx(states_);
  rhs(coefs, x, dx.data());
  Levels out = {values(SurfaceValue::level, coefs, x, 1), rates(coefs, x, dx.data()),
                std::vector<double>(sides_.size())};
  const std::vector<double> gradients = values(SurfaceValue::level_gradient, coefs, x, states_);
  for (std::size_t i = 0; i < gradients.size(); ++i) {
    out.size[i / states_] += std::fabs(gradients[i] * x[i % states_]);
  }
  return out;
}

std::vector<double> HeldField::field_with(const std::vector<double>& sides, const double* coefs,
                                          const double* x) {
  std::vector<double> dx(states_);
  point_->hold(sides);
  contacts_.slope(coefs, x, touches_, dx.data());
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
  hold_contacts(coefs, x);
  find_sides(all, values(SurfaceValue::level, coefs, x, 1), coefs, x);
}

void HeldField::hold_contacts(const double* coefs, const double* x) {
  touches_ = contact_of(contacts_.depths(coefs, x));
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
  // Off the surface the field of the other side means nothing, and may be infinite.
  const double distance = level - level_of(k, above);
  const double own = distance < 0.0 ? down : up;
  if (!(std::fabs(distance) <= kNear * step_ * std::fabs(own))) return;
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

bool HeldField::take_slid() {
  const bool slid = has_slid_;
  has_slid_ = false;
  return slid;
}

}  // namespace gearsweep
