// Products of the small matrices that orbits are judged by: as many rows as a model has states.
#pragma once

#include <Eigen/Core>

namespace gearsweep {

// out = a b, of square matrices of one size; out is another matrix. Eigen packs blocks for its
// product, which takes longer than the product here.
void multiply_small(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd* out);

// A number that no eigenvalue exceeds, as an absolute value, but for rounding: the root of the norm
// of a high power nears the largest from above, to 3 % where that norm is 1000 times the power of
// the largest.
double eigenvalue_bound(const Eigen::MatrixXd& matrix);

}  // namespace gearsweep
