// The bound of eigenvalues beside Eigen's own.
#include "tile/detail/eigenvalue_bound.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace gearsweep::testing {
namespace {

// The bound that says that an orbit is stable may never be below its largest multiplier.
TEST(EigenvalueBound, IsAboveAllEigenvalues) {
  for (int i = 0; i < 200; ++i) {
    const int size = 2 + i % 12;
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(size, size);
    const double largest = matrix.eigenvalues().cwiseAbs().maxCoeff();
    EXPECT_GE(eigenvalue_bound(matrix), largest * (1.0 - 1e-12));
    EXPECT_LE(eigenvalue_bound(matrix), 1.03 * largest);
  }
}

// Defective and nilpotent: norms of powers grow first, or are 0 in the end.
TEST(EigenvalueBound, HoldsWhereEigenvectorsAreMissing) {
  Eigen::MatrixXd jordan = 0.9 * Eigen::MatrixXd::Identity(4, 4);
  for (int i = 0; i < 3; ++i) jordan(i, i + 1) = 100.0;
  EXPECT_GE(eigenvalue_bound(jordan), 0.9);
  Eigen::MatrixXd nilpotent = Eigen::MatrixXd::Zero(3, 3);
  nilpotent(0, 1) = nilpotent(1, 2) = 5.0;
  EXPECT_EQ(eigenvalue_bound(nilpotent), 0.0);
}

}  // namespace
}  // namespace gearsweep::testing
