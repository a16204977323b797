// A model's field with the contact held: where a flank is held to touch its force goes on beyond
// the limit of the backlash, where it is held not to there is none. So the field is smooth, and a
// Runge-Kutta step that ends where the true contact changes keeps its order. The two limits D = b'
// and D = -b' have nothing to do with each other: whatever the sign of b', each has a flank of its
// own, and both may touch.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "model/model.hpp"

namespace gearsweep {

// One entry for each flank: drive, back.
constexpr std::array<double, 2> kFlanks = {1.0, -1.0};
using Contact = std::array<bool, 2>;   // it touches
using Depths = std::array<double, 2>;  // D - b' and -D - b'; it touches where positive

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Contact contact_of(const Depths& depths);

class ContactField {
 public:
  // Both must outlive the field.
  ContactField(const Model& model, const PreparedPoint& point);

  // Of a model without contact: no flank ever touches.
  Depths depths(const double* coefs, const Eigen::VectorXd& state);

  // Writes the derivative by time, and returns the depths at the state.
  Depths slope(const double* coefs, const Eigen::VectorXd& state, const Contact& held,
               Eigen::VectorXd* out);
  // Writes the slope's derivative by the state.
  void jacobian(const double* coefs, const Eigen::VectorXd& state, const Contact& held,
                RowMatrix* out);
  // What the Jacobian gains where a flank begins to touch.
  RowMatrix gained(const double* coefs, const Eigen::VectorXd& state, std::size_t flank);

 private:
  const PreparedPoint& point_;
  bool has_contact_;
  std::size_t deflection_ = 0, backlash_ = 0;  // which signals
  std::vector<double> signals_;
  Eigen::VectorXd force_direction_;
  Eigen::RowVectorXd gradient_;
};

}  // namespace gearsweep
