#include "model/eigenvalues.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace gearsweep::testing {
namespace {

using Values = std::vector<std::complex<double>>;

TEST(Eigenvalues, OfATriangleAreItsDiagonal) {
  const double columns[] = {3.0, 0.0, 7.0, -2.0};
  EXPECT_THAT(eigenvalues(columns, 2),
              ::testing::UnorderedElementsAre(std::complex<double>(3.0), -2.0));
}

TEST(Eigenvalues, OfATurnAreAPairTheUpperOneFirst) {
  const double c = 0.6, s = 0.8;
  const double columns[] = {c, s, -s, c};
  const Values values = eigenvalues(columns, 2);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(values[0].real(), c, 1e-15);
  EXPECT_NEAR(values[0].imag(), s, 1e-15);
  EXPECT_EQ(values[1], std::conj(values[0]));
}

TEST(Eigenvalues, AreNoneWhereTheIterationDoesNotConverge) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double columns[] = {nan, nan, nan, nan, nan, nan, nan, nan, nan};
  EXPECT_TRUE(eigenvalues(columns, 3).empty());
}

}  // namespace
}  // namespace gearsweep::testing
