// Products and bounds of small matrices, beside Eigen's own.
#include "tile/detail/small_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

namespace gearsweep::testing {
namespace {

// Sums of at most 20 products of numbers below 1: some roundings.
TEST(SmallMatrix, IsMultipliedAsEigenDoes) {
  for (const int size : {1, 3, 4, 10, 16, 20}) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(size, size);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(size, size);
    Eigen::MatrixXd product;
    multiply_small(a, b, &product);
    EXPECT_LT((product - a * b).cwiseAbs().maxCoeff(), 1e-14) << size;
  }
}

// The bound that says that an orbit is stable may never be below its largest multiplier.
TEST(SmallMatrix, EigenvaluesStayBelowTheirBound) {
  for (int i = 0; i < 200; ++i) {
    const int size = 2 + i % 12;
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(size, size);
    const double largest = matrix.eigenvalues().cwiseAbs().maxCoeff();
    EXPECT_GE(eigenvalue_bound(matrix), largest * (1.0 - 1e-12));
    EXPECT_LE(eigenvalue_bound(matrix), 1.03 * largest);
  }
}

// Defective and nilpotent: norms of powers grow first, or are 0 in the end.
TEST(SmallMatrix, TheBoundHoldsWhereEigenvectorsAreMissing) {
  Eigen::MatrixXd jordan = 0.9 * Eigen::MatrixXd::Identity(4, 4);
  for (int i = 0; i < 3; ++i) jordan(i, i + 1) = 100.0;
  EXPECT_GE(eigenvalue_bound(jordan), 0.9);
  Eigen::MatrixXd nilpotent = Eigen::MatrixXd::Zero(3, 3);
  nilpotent(0, 1) = nilpotent(1, 2) = 5.0;
  EXPECT_EQ(eigenvalue_bound(nilpotent), 0.0);
}

}  // namespace
}  // namespace gearsweep::testing
