#include "tile/detail/small_matrix.hpp"

#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace gearsweep {
namespace {

using Four = double __attribute__((vector_size(32)));
constexpr std::size_t kMostFours = 4;  // in a column, beyond which Eigen's product is as quick

// The rows of a column, four and four; what is missing of the last four is 0.
struct Column {
  std::array<Four, kMostFours> rows;
};

void multiply_columns(std::size_t size, const Column* a, const double* b, double* out) {
  for (std::size_t column = 0; column < size; ++column) {
    Four sums[kMostFours] = {};
    for (std::size_t k = 0; k < size; ++k) {
      const double factor = b[column * size + k];
      for (std::size_t i = 0; i < kMostFours; ++i) sums[i] += a[k].rows[i] * factor;
    }
    std::memcpy(out + column * size, sums, size * sizeof(double));
  }
}

}  // namespace

void multiply_small(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd* out) {
  const auto size = static_cast<std::size_t>(a.rows());
  if (size > 4 * kMostFours) {
    out->noalias() = a * b;
    return;
  }
  std::array<Column, 4 * kMostFours> columns = {};
  for (std::size_t k = 0; k < size; ++k) {
    std::memcpy(&columns[k], a.data() + k * size, size * sizeof(double));
  }
  out->resize(a.rows(), a.cols());
  multiply_columns(size, columns.data(), b.data(), out->data());
}

double eigenvalue_bound(const Eigen::MatrixXd& matrix) {
  constexpr int kSquarings = 8;
  Eigen::MatrixXd power = matrix, square;
  double log_bound = 0.0, share = 1.0;  // of the power's logarithm
  for (int i = 0; i < kSquarings; ++i) {
    const double norm = power.norm();
    if (!(norm > 0.0)) return norm;
    power /= norm;
    log_bound += share * std::log(norm);
    multiply_small(power, power, &square);
    power.swap(square);
    share *= 0.5;
  }
  return std::exp(log_bound + share * std::log(power.norm()));
}

}  // namespace gearsweep
