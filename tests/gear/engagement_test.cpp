// How gradually a pair of teeth takes up its load, from a drawing.
#include "gear/detail/engagement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gear/drawing_table.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

struct Point {
  double x, y;
};

// How far the driving gear, whose centre is the origin, has still to turn until a corner of the
// driven one lies on its flank: that flank is drawn as points, and turned until the corner changes
// sides. At angle 0 the flank crosses the line of action x = base at y = at.
double turn_until_met(double base, double at, const Point& corner) {
  const auto is_met = [&](double turn) {
    // The flank begins on the base circle, at the angle at/base, and a string unwinds from there.
    const double begin = at / base + turn, radius = std::hypot(corner.x, corner.y);
    double low = 0.0, high = 2.0;  // unwound angle
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (base * std::hypot(1.0, middle) < radius ? low : high) = middle;
    }
    const double tangent = begin - low;
    const Point flank = {base * (std::cos(tangent) - low * std::sin(tangent)),
                         base * (std::sin(tangent) + low * std::cos(tangent))};
    return flank.x * corner.y - flank.y * corner.x < 0.0;  // the corner lies behind
  };
  double low = -0.5, high = 0.5;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (is_met(middle) ? high : low) = middle;
  }
  return low;
}

TEST(Engagement, GapOfATipCornerIsThatOfTheFlanks) {
  const double alpha = 20.0 * std::numbers::pi / 180.0;
  for (const auto& [z1, z2] : {std::pair(40.0, 40.0), std::pair(19.0, 61.0)}) {
    const double base_1 = 1.5 * z1 * std::cos(alpha), base_2 = 1.5 * z2 * std::cos(alpha);
    const double tip = 1.5 * z2 + 3.0, reach = std::sqrt(tip * tip - base_2 * base_2);
    const double length = (base_1 + base_2) * std::tan(alpha), begin = length - reach;
    for (const double ahead : {0.1, 1.0, 3.0}) {
      // The driven gear's centre, and its corner, which is turned back around it.
      const double turn = ahead / base_2;
      const Point corner = {base_1 + base_2 - base_2 * std::cos(turn) + reach * std::sin(turn),
                            length - base_2 * std::sin(turn) - reach * std::cos(turn)};
      const double gap = base_1 * turn_until_met(base_1, begin - ahead, corner);
      EXPECT_GT(gap, 0.0);
      EXPECT_NEAR(corner_gap(base_1, base_2, alpha, reach, ahead), gap, 1e-9);
    }
  }
}

// The tips of 20 and 40 teeth touch the earlier, the more a pair gives way, and as the square root
// of that as long as it is little.
TEST(Engagement, FollowsFromTheDeflection) {
  const auto engagement = [](double torque) {
    return value_of(
        convert(with(unequal_pair(), kTorque, {torque}), {{kToothEntry.name, "gradual"}}),
        "engagement");
  };
  EXPECT_NEAR(engagement(4.0) / engagement(1.0), 2.0, 0.02);
  EXPECT_GT(engagement(150.0), 0.03);
  EXPECT_LT(engagement(150.0), 0.2);
  EXPECT_FALSE(has(convert(unequal_pair()), "engagement"));
  EXPECT_EQ(value_of(convert(with(unequal_pair(), kEngagement, {0.1})), "engagement"), 0.1);
}

TEST(Engagement, RefusesWhatMakesNoSense) {
  EXPECT_THAT(message_of(with(unequal_pair(), kEngagement, {0.1}), {{kToothEntry.name, "gradual"}}),
              HasSubstr("keep one"));
  EXPECT_THAT(message_of(with(unequal_pair(), kHelix, {10}), {{kToothEntry.name, "gradual"}}),
              HasSubstr("is for spur gears"));
}

}  // namespace
}  // namespace gearsweep::testing
