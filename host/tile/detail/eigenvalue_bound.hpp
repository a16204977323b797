// A bound of a matrix's eigenvalues, for a fraction of what they cost.
#pragma once

#include <Eigen/Core>

namespace gearsweep {

// A number that no eigenvalue exceeds, as an absolute value, but for rounding: the root of the norm
// of a high power nears the largest from above, to 3 % where that norm is 1000 times the power of
// the largest.
double eigenvalue_bound(const Eigen::MatrixXd& matrix);

}  // namespace gearsweep
