#include "measure/samples.hpp"

#include <gtest/gtest.h>

namespace gearsweep::testing {
namespace {

TEST(Samples, TellWhatTheySayTogether) {
  EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_EQ(median({4.0, 1.0, 2.0, 3.0}), 2.5);
  EXPECT_EQ(mean({1.0, 2.0, 6.0}), 3.0);
  EXPECT_DOUBLE_EQ(standard_deviation({1.0, 3.0, 5.0}), 2.0);
  EXPECT_EQ(spread({1.0, 2.0, 4.0}), 1.5);
}

TEST(Samples, OneHasNoSpread) {
  EXPECT_EQ(median({7.0}), 7.0);
  EXPECT_EQ(standard_deviation({7.0}), 0.0);
  EXPECT_EQ(spread({7.0}), 0.0);
}

}  // namespace
}  // namespace gearsweep::testing
