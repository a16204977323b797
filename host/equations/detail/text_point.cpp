#include "equations/detail/text_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "expression/scratch.hpp"

namespace gearsweep {

TextPoint::TextPoint(std::shared_ptr<const Tapes> tapes, const ModelSetting& setting)
    : tapes_(std::move(tapes)),
      moment_(tapes_->states + tapes_->are_staircases.size() + tapes_->points) {
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

void TextPoint::run(const Tape& tape, const double* coefs, const double* x, double* out) const {
  const std::vector<bool>& are_staircases = tapes_->are_staircases;
  Scratch scratch(moment_.size() + tapes_->coef_count);
  double* const moment = scratch.data();
  double* const sides = moment + tapes_->states;
  std::copy_n(coefs, tapes_->coef_count, std::ranges::copy(moment_, moment).out);
  std::copy_n(x, tapes_->states, moment);
  if (sides_.empty() && !are_staircases.empty()) {
    // No level depends on a side.
    Scratch levels(are_staircases.size());
    tapes_->of_surfaces.at(SurfaceValue::level).run(moment, levels.data());
    for (std::size_t i = 0; i < are_staircases.size(); ++i) {
      const double level = levels.data()[i];
      sides[i] = are_staircases[i] ? std::floor(level) : level > 0.0 ? 1.0 : 0.0;
    }
  } else {
    std::ranges::copy(sides_, sides);
  }
  tape.run(moment, out);
}

}  // namespace gearsweep
