// Bounds of confidence against SciPy's beta distribution: beta.ppf(0.95, found + 1, points -
// found).
#include "sweep/detail/share_bound.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gearsweep::testing {
namespace {

TEST(ShareBound, IsThatOfClopperAndPearson) {
  EXPECT_NEAR(upper_share(0, 100), 1.0 - std::pow(0.05, 0.01), 1e-12);
  EXPECT_NEAR(upper_share(2, 240), 0.025998688, 1e-8);
  EXPECT_NEAR(upper_share(1, 3), 0.864649638, 1e-8);
  EXPECT_NEAR(upper_share(30, 1024), 0.039528683, 1e-8);
}

TEST(ShareBound, IsOneWhereNothingIsKnown) {
  EXPECT_EQ(upper_share(0, 0), 1.0);
  EXPECT_EQ(upper_share(7, 7), 1.0);
}

}  // namespace
}  // namespace gearsweep::testing
