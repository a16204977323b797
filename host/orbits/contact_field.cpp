#include "orbits/contact_field.hpp"

namespace gearsweep {

Contact contact_of(const Depths& depths) {
  Contact contact;
  for (const double depth : depths) contact.push_back(depth > 0.0);
  return contact;
}

ContactField::ContactField(const Model& model, const PreparedPoint& point)
    : point_(point),
      limits_(model.contact_limits()),
      places_(2 * (model.contacts.size() + model.corners)),
      force_direction_(static_cast<Eigen::Index>(model.states.size())),
      gradient_(static_cast<Eigen::Index>(model.states.size())) {}

Depths ContactField::depths(const double* coefs, const Eigen::VectorXd& state) {
  Depths out;
  if (limits_.empty()) return out;
  point_.contact_places(coefs, state.data(), places_.data());
  for (const ContactLimit& limit : limits_) {
    const double* const place = &places_[2 * limit.contact];
    out.push_back(limit.flank * place[0] - place[1]);
  }
  return out;
}

Depths ContactField::slope(const double* coefs, const Eigen::VectorXd& state, const Contact& held,
                           Eigen::VectorXd* out) {
  point_.rhs(coefs, state.data(), out->data());
  const Depths seen = depths(coefs, state);
  const Contact actual = contact_of(seen);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == actual[i]) continue;
    point_.force_direction(limits_[i].contact, coefs, state.data(), force_direction_.data());
    *out += (held[i] ? 1.0 : -1.0) * limits_[i].flank * seen[i] * force_direction_;
  }
  return seen;
}

void ContactField::jacobian(const double* coefs, const Eigen::VectorXd& state, const Contact& held,
                            RowMatrix* out) {
  point_.jacobian(coefs, state.data(), out->data());
  const Depths seen = depths(coefs, state);
  const Contact actual = contact_of(seen);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == actual[i]) continue;
    RowMatrix turned(out->rows(), out->cols());
    point_.force_direction_slope(limits_[i].contact, coefs, state.data(), turned.data());
    *out += (held[i] ? 1.0 : -1.0) * (force_at(coefs, state, i) * gradient_at(coefs, state, i) +
                                      limits_[i].flank * seen[i] * turned);
  }
}

const Eigen::VectorXd& ContactField::force_at(const double* coefs, const Eigen::VectorXd& state,
                                              std::size_t limit) {
  point_.force_direction(limits_[limit].contact, coefs, state.data(), force_direction_.data());
  return force_direction_;
}

const Eigen::RowVectorXd& ContactField::gradient_at(const double* coefs,
                                                    const Eigen::VectorXd& state,
                                                    std::size_t limit) {
  point_.penetration_gradient(limits_[limit], coefs, state.data(), gradient_.data());
  return gradient_;
}

}  // namespace gearsweep
