#include "model/contact_field.hpp"

namespace gearsweep {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

HeldContacts contact_of(const Depths& depths) {
  HeldContacts contact;
  for (const double depth : depths) contact.push_back(depth > 0.0);
  return contact;
}

ContactField::ContactField(const Model& model, const PreparedPoint& point)
    : point_(point),
      limits_(model.contact_limits()),
      places_(2 * (model.contacts.size() + model.corners)),
      depths_(limits_.size()),
      force_direction_(static_cast<Eigen::Index>(model.full().states.size())),
      gradient_(static_cast<Eigen::Index>(model.full().states.size())) {}

const Depths& ContactField::depths(const double* coefs, const double* x) {
  if (limits_.empty()) return depths_;
  point_.contact_places(coefs, x, places_.data());
  for (std::size_t i = 0; i < limits_.size(); ++i) {
    const double* const place = &places_[2 * limits_[i].contact];
    depths_[i] = limits_[i].flank * place[0] - place[1];
  }
  return depths_;
}

void ContactField::slope(const double* coefs, const double* x, const HeldContacts& held,
                         double* out) {
  point_.rhs(coefs, x, out);
  if (held.empty()) return;
  const Depths& seen = depths(coefs, x);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == (seen[i] > 0.0)) continue;
    const Eigen::VectorXd& force = force_at(coefs, x, i);
    Eigen::VectorXd::Map(out, force.size()) +=
        (held[i] ? 1.0 : -1.0) * limits_[i].flank * seen[i] * force;
  }
}

void ContactField::jacobian(const double* coefs, const double* x, const HeldContacts& held,
                            double* out) {
  point_.jacobian(coefs, x, out);
  if (held.empty()) return;
  const Eigen::Index states = force_direction_.size();
  const Depths& seen = depths(coefs, x);
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == (seen[i] > 0.0)) continue;
    RowMajor turned(states, states);
    point_.force_direction_slope(limits_[i].contact, coefs, x, turned.data());
    RowMajor::Map(out, states, states) +=
        (held[i] ? 1.0 : -1.0) *
        (force_at(coefs, x, i) * gradient_at(coefs, x, i) + limits_[i].flank * seen[i] * turned);
  }
}

const Eigen::VectorXd& ContactField::force_at(const double* coefs, const double* x,
                                              std::size_t limit) {
  point_.force_direction(limits_[limit].contact, coefs, x, force_direction_.data());
  return force_direction_;
}

const Eigen::RowVectorXd& ContactField::gradient_at(const double* coefs, const double* x,
                                                    std::size_t limit) {
  point_.penetration_gradient(limits_[limit], coefs, x, gradient_.data());
  return gradient_;
}

}  // namespace gearsweep
