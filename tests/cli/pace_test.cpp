// The time left is told when it is known, and not before. No clock: each report bears its time.
#include "cli/detail/pace.hpp"

#include <gtest/gtest.h>

namespace gearsweep {
namespace {

SweepProgress progress(double seconds, double share, double kept, double resumed = 0.0) {
  SweepProgress report;
  report.seconds = seconds;
  report.share = share;
  report.share_kept = kept;
  report.share_resumed = resumed;
  report.points = 1000;
  return report;
}

// Kernels take 4 s to build, the first rounds are small, and the points of a tile stop long before
// the end that was planned for them: after 4.5 s a plain quotient would say 8 min.
TEST(Pace, SaysNothingBeforeATileIsMeasured) {
  PaceMeter meter;
  EXPECT_FALSE(meter.at(progress(0.0, 0.0, 0.0)));
  EXPECT_FALSE(meter.at(progress(4.0, 0.005, 0.0)));
  EXPECT_FALSE(meter.at(progress(4.5, 0.009, 0.0)));
  EXPECT_FALSE(meter.at(progress(6.0, 0.15, 0.1))) << "the first tile had the kernels built";
  EXPECT_FALSE(meter.at(progress(7.0, 0.2, 0.1)));
  const std::optional<Pace> pace = meter.at(progress(8.0, 0.25, 0.2));
  ASSERT_TRUE(pace);
  EXPECT_NEAR(pace->seconds_left, 2.0 / 0.1 * 0.75, 1e-9);
  EXPECT_NEAR(pace->points_per_second, 0.1 * 1000 / 2.0, 1e-9);
}

TEST(Pace, CountsDownBetweenTiles) {
  PaceMeter meter;
  meter.at(progress(1.0, 0.25, 0.25));
  ASSERT_TRUE(meter.at(progress(3.0, 0.75, 0.75)));
  EXPECT_NEAR(meter.at(progress(3.4, 0.76, 0.75))->seconds_left, 0.6, 1e-9);
  EXPECT_FALSE(meter.at(progress(4.1, 0.77, 0.75))) << "it takes longer than was measured";
}

TEST(Pace, TooLittleIsNotMeasured) {
  PaceMeter meter;
  meter.at(progress(1.0, 0.01, 0.01));
  EXPECT_FALSE(meter.at(progress(1.9, 0.11, 0.11))) << "too short";
  PaceMeter other;
  other.at(progress(1.0, 0.01, 0.01));
  EXPECT_FALSE(other.at(progress(9.0, 0.05, 0.05))) << "too small a share";
  EXPECT_TRUE(other.at(progress(10.0, 0.07, 0.07)));
}

TEST(Pace, OfALongRunTheFirstTileTells) {
  PaceMeter meter;
  EXPECT_FALSE(meter.at(progress(500.0, 0.02, 0.0)));
  const std::optional<Pace> pace = meter.at(progress(600.0, 0.03, 0.03));
  ASSERT_TRUE(pace);
  EXPECT_NEAR(pace->seconds_left, 600.0 / 0.03 * 0.97, 1e-6);
}

TEST(Pace, WhatTheJournalGaveIsNoSpeed) {
  PaceMeter meter;
  EXPECT_FALSE(meter.at(progress(0.0, 0.3, 0.3, 0.3)));
  EXPECT_FALSE(meter.at(progress(0.0, 0.5, 0.5, 0.5)));
  EXPECT_FALSE(meter.at(progress(4.0, 0.6, 0.6, 0.5)));
  const std::optional<Pace> pace = meter.at(progress(6.0, 0.7, 0.7, 0.5));
  ASSERT_TRUE(pace);
  EXPECT_NEAR(pace->seconds_left, 2.0 / 0.1 * 0.3, 1e-9);
}

}  // namespace
}  // namespace gearsweep
