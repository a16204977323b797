// A model's field with the contact held: where a flank is held to touch its force goes on beyond
// the limit of the backlash, where it is held not to there is none. So the field is smooth, and a
// Runge-Kutta step that ends where the true contact changes keeps its order. Limits have nothing to
// do with each other: whatever the sign of b', D = b' and D = -b' have a flank each, and both may
// touch.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// One entry for each of the model's limits (Model::contact_limits()).
using HeldContacts = std::vector<bool>;  // it touches
using Depths = std::vector<double>;      // D - b' or -D - b'; it touches where positive

HeldContacts contact_of(const Depths& depths);

class ContactField {
 public:
  // Both must outlive the field.
  ContactField(const Model& model, const PreparedPoint& point);

  // coefs: a row of phase coefficients; x: a state.
  const Depths& depths(const double* coefs, const double* x);

  // Writes the derivative by time. No contact at all is held where `held` is empty.
  void slope(const double* coefs, const double* x, const HeldContacts& held, double* out);
  // Writes the slope's derivative by the state, row by row.
  void jacobian(const double* coefs, const double* x, const HeldContacts& held, double* out);
  // What the field gains per distance beyond a flank, and the distance's derivative by the state:
  // their product is what the Jacobian gains where the flank begins to touch. The distance is the
  // depth on the drive flank, and less the depth on the back flank.
  const Eigen::VectorXd& force_at(const double* coefs, const double* x, std::size_t limit);
  const Eigen::RowVectorXd& gradient_at(const double* coefs, const double* x, std::size_t limit);

 private:
  const PreparedPoint& point_;
  std::vector<ContactLimit> limits_;
  std::vector<double> places_;  // deflection and backlash of each contact and corner
  Depths depths_;
  Eigen::VectorXd force_direction_;
  Eigen::RowVectorXd gradient_;
};

}  // namespace gearsweep
