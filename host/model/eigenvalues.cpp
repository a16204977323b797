#include "model/eigenvalues.hpp"

#include <Eigen/Eigenvalues>

namespace gearsweep {

namespace {

// `most`: rows that the matrix has at most, or Eigen::Dynamic.
template <int most>
std::vector<std::complex<double>> eigenvalues_of(const double* matrix, Eigen::Index rows) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most>;
  const Eigen::EigenSolver<Matrix> solver(Eigen::Map<const Matrix>(matrix, rows, rows), false);
  if (solver.info() != Eigen::Success) return {};
  return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

}  // namespace

std::vector<std::complex<double>> eigenvalues(const double* matrix, std::size_t size) {
  // The matrices of a search for orbits, which are many, take a dozen blocks less of the heap.
  constexpr int kSmall = 16;
  const auto rows = static_cast<Eigen::Index>(size);
  return rows <= kSmall ? eigenvalues_of<kSmall>(matrix, rows)
                        : eigenvalues_of<Eigen::Dynamic>(matrix, rows);
}

}  // namespace gearsweep
