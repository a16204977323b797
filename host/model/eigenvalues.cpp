#include "model/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace gearsweep {

std::vector<std::complex<double>> eigenvalues(const double* matrix, std::size_t size) {
  const auto rows = static_cast<Eigen::Index>(size);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(
      Eigen::Map<const Eigen::MatrixXd>(matrix, rows, rows), false);
  if (solver.info() != Eigen::Success) return {};
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

}  // namespace gearsweep
