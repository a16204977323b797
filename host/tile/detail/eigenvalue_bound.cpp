#include "tile/detail/eigenvalue_bound.hpp"

#include <cmath>

namespace gearsweep {

double eigenvalue_bound(const Eigen::MatrixXd& matrix) {
  constexpr int kSquarings = 8;
  Eigen::MatrixXd power = matrix, square(matrix.rows(), matrix.cols());
  double log_bound = 0.0, share = 1.0;  // of the power's logarithm
  for (int i = 0; i < kSquarings; ++i) {
    const double norm = power.norm();
    if (!(norm > 0.0)) return norm;
    power /= norm;
    log_bound += share * std::log(norm);
    square.noalias() = power * power;
    power.swap(square);
    share *= 0.5;
  }
  return std::exp(log_bound + share * std::log(power.norm()));
}

}  // namespace gearsweep
