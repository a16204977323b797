#include "equations/detail/text_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gearsweep {

TextPoint::TextPoint(std::shared_ptr<const Tapes> tapes, const ModelSetting& setting)
    : tapes_(std::move(tapes)),
      moment_(tapes_->states + tapes_->are_staircases.size() + tapes_->points +
              tapes_->coef_count) {
  const std::vector<double> inputs = inputs_of(*tapes_, setting);
  period_ = tapes_->period.run(inputs);
  tapes_->point.run(inputs.data(), moment_.data() + tapes_->states + tapes_->are_staircases.size());
}

void TextPoint::rhs(const double* coefs, const double* x, double* dx) const {
  run(tapes_->rhs, coefs, x, dx);
}

void TextPoint::jacobian(const double* coefs, const double* x, double* out) const {
  run(tapes_->jacobian, coefs, x, out);
}

void TextPoint::signals(const double* coefs, const double* x, double* out) const {
  run(tapes_->signals, coefs, x, out);
}

void TextPoint::contact_places(const double* coefs, const double* x, double* out) const {
  run(tapes_->contact_places, coefs, x, out);
}

void TextPoint::force_direction(std::size_t contact, const double* coefs, const double* x,
                                double* out) const {
  run(tapes_->contacts[contact].direction, coefs, x, out);
}

void TextPoint::force_direction_slope(std::size_t contact, const double* coefs, const double* x,
                                      double* out) const {
  run(tapes_->contacts[contact].direction_slope, coefs, x, out);
}

void TextPoint::penetration_gradient(const ContactLimit& limit, const double* coefs,
                                     const double* x, double* out) const {
  std::vector<double> gradients(2 * tapes_->states);
  run(tapes_->contacts[limit.contact].gradients, coefs, x, gradients.data());
  for (std::size_t j = 0; j < tapes_->states; ++j) {
    out[j] = gradients[j] - limit.flank * gradients[tapes_->states + j];
  }
}

void TextPoint::of_surfaces(SurfaceValue value, const double* coefs, const double* x,
                            double* out) const {
  run(tapes_->of_surfaces.at(value), coefs, x, out);
}

std::vector<double> TextPoint::moment_at(const double* coefs, const double* x) const {
  std::vector<double> moment = moment_;
  std::copy_n(x, tapes_->states, moment.begin());
  std::copy_n(coefs, tapes_->coef_count,
              moment.end() - static_cast<std::ptrdiff_t>(tapes_->coef_count));
  return moment;
}

void TextPoint::run(const Tape& tape, const double* coefs, const double* x, double* out) const {
  std::vector<double> moment = moment_at(coefs, x);
  const std::vector<bool>& are_staircases = tapes_->are_staircases;
  std::vector<double> sides = sides_;
  if (sides.empty() && !are_staircases.empty()) {
    sides.resize(are_staircases.size());
    // No level depends on a side.
    tapes_->of_surfaces.at(SurfaceValue::level).run(moment.data(), sides.data());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      sides[i] = are_staircases[i] ? std::floor(sides[i]) : sides[i] > 0.0 ? 1.0 : 0.0;
    }
  }
  std::ranges::copy(sides, moment.begin() + static_cast<std::ptrdiff_t>(tapes_->states));
  tape.run(moment.data(), out);
}

}  // namespace gearsweep
