// Draws of uncertain parameters: judged by quantiles of Boost.Math and by moments.
#include "study/detail/draws.hpp"

#include <gtest/gtest.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <cmath>

namespace gearsweep::testing {
namespace {

TEST(Draws, QuantilesAreThoseOfBoost) {
  const boost::math::normal normal;
  const boost::math::triangular triangular(-1.0, 0.5, 3.0);
  for (double p : {1e-15, 1e-9, 1e-3, 0.02, 0.074, 0.076, 0.3, 0.5, 0.6, 0.924, 0.93, 0.9999}) {
    const double expected = boost::math::quantile(normal, p);
    EXPECT_NEAR(normal_quantile(p), expected, 1e-14 * (1.0 + std::fabs(expected))) << p;
    EXPECT_NEAR(triangular_quantile(-1.0, 0.5, 3.0, p), boost::math::quantile(triangular, p),
                1e-14 * 4.0)
        << p;
  }
}

// The mean of 10^6 numbers is known to 0.0003 (one standard error), and so are the others.
TEST(Draws, UniformNumbersHaveTheMomentsAndNoMemory) {
  constexpr std::size_t kCount = 1000000;
  double mean = 0.0, square = 0.0, neighbours = 0.0, streams = 0.0, seeds = 0.0, tenth = 0.0;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double u = uniform_at(1, "mu", i) - 0.5;
    ASSERT_LT(std::fabs(u), 0.5);
    mean += u / kCount;
    square += u * u / kCount;
    tenth += (u < -0.4 ? 1.0 : 0.0) / kCount;
    neighbours += u * (uniform_at(1, "mu", i + 1) - 0.5) / kCount;
    streams += u * (uniform_at(1, "e0", i) - 0.5) / kCount;
    seeds += u * (uniform_at(2, "mu", i) - 0.5) / kCount;
  }
  EXPECT_NEAR(mean, 0.0, 0.0012);
  EXPECT_NEAR(square, 1.0 / 12.0, 0.0003);
  EXPECT_NEAR(tenth, 0.1, 0.0012);
  for (const double product : {neighbours, streams, seeds}) EXPECT_NEAR(product, 0.0, 0.00034);
}

}  // namespace
}  // namespace gearsweep::testing
