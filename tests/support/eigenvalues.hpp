// Eigenvalues, without the solver in every test that asks for some: it takes long to compile.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "model/eigenvalues.hpp"

namespace gearsweep::testing {

inline Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& matrix) {
  const std::vector<std::complex<double>> values =
      eigenvalues(matrix.data(), static_cast<std::size_t>(matrix.rows()));
  return Eigen::Map<const Eigen::VectorXcd>(values.data(),
                                            static_cast<Eigen::Index>(values.size()));
}

}  // namespace gearsweep::testing
