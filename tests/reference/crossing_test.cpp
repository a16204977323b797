// What a step misses at a crossing, where it is known in closed form.
#include "reference/detail/crossing.hpp"

#include <gtest/gtest.h>

namespace gearsweep::testing {
namespace {

// p = s (u - c) with u at the evaluations 0, 1/2, 1/2, 1.
Eigen::Vector4d line(double s, double c) {
  return s * (Eigen::Vector4d(0.0, 0.5, 0.5, 1.0).array() - c);
}

std::optional<CrossingWeights> weights_of(const Eigen::Vector4d& p, double flank) {
  return crossing_weights(p, p, flank);
}

// The true force's integral is s (1 - c)^2/2, its moment about the end s (1 - c)^3/6; the
// evaluations saw s (2/3 (1/2 - c) + 1/6 (1 - c)) and s/3 (1/2 - c), or less. To rounding.
TEST(CrossingWeights, GiveWhatAStepMissesOfAStraightLine) {
  const double s = 0.3;
  for (const double c : {0.2, 0.49, 0.7, 0.99}) {
    const double rest = 1.0 - c;
    const double seen = c < 0.5 ? s * (0.5 - c) : 0.0;
    const double sum = s * rest * rest / 2.0 - (2.0 / 3.0 * seen + s * rest / 6.0);
    const double moment = s * rest * rest * rest / 6.0 - seen / 3.0;
    const auto met = weights_of(line(s, c), 1.0);
    ASSERT_TRUE(met);
    EXPECT_NEAR(met->sum.dot(line(s, c)), sum, 1e-15);
    EXPECT_NEAR(met->moment.dot(line(s, c)), moment, 1e-15);
    // Leaving the drive flank, p falls below 0, where the force stays 0: the same excess.
    const auto left = weights_of(line(-s, c), 1.0);
    ASSERT_TRUE(left);
    EXPECT_NEAR(left->sum.dot(line(-s, c)), sum, 1e-15);
    // The back flank is the mirror image.
    const auto back = weights_of(line(-s, c), -1.0);
    ASSERT_TRUE(back);
    EXPECT_NEAR(back->sum.dot(line(-s, c)), -sum, 1e-15);
    EXPECT_NEAR(back->moment.dot(line(-s, c)), -moment, 1e-15);
  }
}

TEST(CrossingWeights, AreNothingWithoutACrossing) {
  EXPECT_FALSE(weights_of(line(1.0, -0.1), 1.0));
  EXPECT_FALSE(weights_of(line(1.0, 1.1), 1.0));
  EXPECT_FALSE(weights_of(line(-1.0, -0.1), -1.0));
}

}  // namespace
}  // namespace gearsweep::testing
