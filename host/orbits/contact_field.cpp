#include "orbits/contact_field.hpp"

namespace gearsweep {

Contact contact_of(const Depths& depths) { return {depths[0] > 0.0, depths[1] > 0.0}; }

ContactField::ContactField(const Model& model, const PreparedPoint& point)
    : point_(point),
      has_contact_(model.has_contact),
      signals_(model.signals.size()),
      force_direction_(static_cast<Eigen::Index>(model.states.size())),
      gradient_(static_cast<Eigen::Index>(model.states.size())) {
  if (!has_contact_) return;
  deflection_ = static_cast<std::size_t>(model.find_signal("deflection"));
  backlash_ = static_cast<std::size_t>(model.find_signal("backlash"));
}

Depths ContactField::depths(const double* coefs, const Eigen::VectorXd& state) {
  if (!has_contact_) return {-1.0, -1.0};
  point_.signals(coefs, state.data(), signals_.data());
  Depths out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = kFlanks[i] * signals_[deflection_] - signals_[backlash_];
  }
  return out;
}

Depths ContactField::slope(const double* coefs, const Eigen::VectorXd& state, const Contact& held,
                           Eigen::VectorXd* out) {
  point_.rhs(coefs, state.data(), out->data());
  const Depths seen = depths(coefs, state);
  const Contact actual = contact_of(seen);
  if (actual == held) return seen;
  point_.force_direction(coefs, force_direction_.data());
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == actual[i]) continue;
    *out += (held[i] ? 1.0 : -1.0) * kFlanks[i] * seen[i] * force_direction_;
  }
  return seen;
}

void ContactField::jacobian(const double* coefs, const Eigen::VectorXd& state, const Contact& held,
                            RowMatrix* out) {
  point_.jacobian(coefs, state.data(), out->data());
  const Contact actual = contact_of(depths(coefs, state));
  if (actual == held) return;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == actual[i]) continue;
    *out += (held[i] ? 1.0 : -1.0) * gained(coefs, state, i);
  }
}

RowMatrix ContactField::gained(const double* coefs, const Eigen::VectorXd& state,
                               std::size_t flank) {
  point_.force_direction(coefs, force_direction_.data());
  point_.penetration_gradient(coefs, state.data(), kFlanks[flank], gradient_.data());
  return force_direction_ * gradient_;
}

}  // namespace gearsweep
