// Centre distances, pressure angles, tips and the path of contact against textbooks and other ways
// to the same numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gear/drawing_table.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// 20 and 30 teeth of module 4 with x1 + x2 = 0.28 stand 101.0777 mm apart without play, by
// bisection elsewhere. Drawings round.
TEST(Geometry, RefusesWhatCannotBeAssembled) {
  const Table shifted =
      with(with(with(table_1(), kTeeth, {20, 30}), kModule, {4}), kProfileShift, {0.28, 0});
  const auto at = [&](double centre) { return with(shifted, kCentreDistance, {centre}); };
  EXPECT_THAT(message_of(at(100.0)),
              AllOf(HasSubstr("centre_distance_mm: centre_distance_mm = 100 is too small"),
                    HasSubstr("101.078 mm")));
  EXPECT_THAT(message_of(at(101.06)), HasSubstr("too small"));
  for (const double centre : {101.07, 101.08, 101.5}) EXPECT_EQ(message_of(at(centre)), "accepted");
  EXPECT_THAT(message_of(with(table_1(), kCentreDistance, {119.9})), HasSubstr("too small"));
  EXPECT_EQ(message_of(with(table_1(), kCentreDistance, {119.999})), "accepted");
  // The flanks of a tooth of this pinion meet at 92.3 mm, by bisection elsewhere.
  const Table pointed = without(unequal_pair(), kAddendum);
  const auto tips = [&](double pinion) { return with(pointed, kTipDiameter, {pinion, 167.0}); };
  EXPECT_EQ(message_of(tips(91.0)), "accepted");
  EXPECT_THAT(message_of(tips(93.0)), HasSubstr("teeth of the pinion come to a point"));
}

TEST(Geometry, AGivenContactRatioKeepsTheSplitAtThePitchPoint) {
  const GearConversion drawn = convert(unequal_pair());
  const GearConversion given = convert(with(unequal_pair(), kContactRatio, {1.5}));
  EXPECT_EQ(value_of(given, "eps"), 1.5);
  EXPECT_EQ(value_of(given, "approach"), value_of(drawn, "approach"));
  EXPECT_THAT(notes_of(given), HasSubstr("contact ratio 1.5 as given"));
}

TEST(Geometry, ALongerAddendumOfTheGearLengthensTheApproach) {
  const GearConversion gear = convert(with(table_1(), kAddendum, {3.0, 3.2}));
  EXPECT_GT(value_of(gear, "approach"), 0.5);
}

// Same method as for the unequal pair, with cos(alpha_w) = (Rp + Rg)/120.8 mm.
TEST(Geometry, AWiderCentreDistanceWorksAtItsOwnPressureAngle) {
  Table table = with(unequal_pair(), kCentreDistance, {120.8});
  table.erase(kAddendum.name);
  const GearConversion gear = convert(table);
  // The arc cosine is steep here by 1/tan(alpha_w) = 2.6; in degrees.
  EXPECT_NEAR(value_of(gear, "alpha"), 21.0177292189549613, 21.0 * 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "eps"), 1.44182348234448357, 50.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "approach"), 0.504818030763626440, 50.0 * kRounding);
  expect_value(gear, "A", 3020.0);
}

TEST(Geometry, TheStandardCentreDistanceChangesNothing) {
  const GearConversion gear = convert(with(table_1(), kCentreDistance, {120}));
  const GearConversion rounded = convert(with(table_1(), kCentreDistance, {120.00001}));
  EXPECT_EQ(value_of(gear, "alpha"), value_of(convert(table_1()), "alpha"));
  EXPECT_EQ(value_of(rounded, "alpha"), value_of(gear, "alpha"));
  EXPECT_EQ(value_of(gear, "eps"), value_of(convert(table_1()), "eps"));
}

// Teeth 12 and 24 of module 3 mm with shifts 0.6 and 0.36: KHK, Gear Technical Reference, table
// 4.3, has alpha_w = 26.0886 degrees and a centre distance of 56.4999 mm.
TEST(Geometry, ProfileShiftGivesTheWorkingPressureAngle) {
  Table table = with(table_1(), kTeeth, {12, 24});
  table[kProfileShift.name] = {0.6, 0.36};
  table[kTipDiameter.name] = {44.84, 79.4};
  const GearConversion gear = convert(table);
  EXPECT_NEAR(value_of(gear, "alpha"), 26.0886, 5e-5);
  EXPECT_NEAR(value_of(gear, "A") * 0.05, 56.4999, 5e-5);
  // The same gear by its centre distance.
  const double centre = value_of(gear, "A") * 0.05;
  table[kCentreDistance.name] = {centre};
  EXPECT_NEAR(value_of(convert(table), "alpha"), value_of(gear, "alpha"), 1e-9);
  EXPECT_NEAR(value_of(convert(table), "eps"), value_of(gear, "eps"), 1e-9);
}

TEST(Geometry, TipDiametersAreTwiceTheReferenceRadiusAndTheAddendum) {
  const GearConversion own = convert(table_1());
  const GearConversion tips = convert(with(table_1(), kTipDiameter, {126}));
  EXPECT_NEAR(value_of(tips, "eps"), value_of(own, "eps"), 1e-14);
  Table both = with(table_1(), kTipDiameter, {126});
  both[kAddendum.name] = {3};
  EXPECT_THAT(message_of(both), HasSubstr("keep one"));
  // A shift of one gear against the other leaves the centre distance, and moves the pitch point.
  const GearConversion shifted = convert(with(table_1(), kProfileShift, {0.2, -0.2}));
  EXPECT_EQ(value_of(shifted, "alpha"), value_of(own, "alpha"));
  EXPECT_LT(value_of(shifted, "approach"), 0.5);
}

TEST(Geometry, AContactRatioOutOfRangeIsExplained) {
  const Table table = with(table_1(), kAddendum, {1.0});
  EXPECT_THAT(message_of(table),
              AllOf(HasSubstr("addendum_mm gives eps = "), HasSubstr("contact ratio"),
                    HasSubstr("from 1.001 to 1.999 is allowed")));
}

// A rack of standard addendum undercuts 20 degree pinions of fewer than 17 teeth, and a gear of 40
// teeth those of fewer than 15.
TEST(Geometry, TipsThatWouldUndercutTheMateAreRefused) {
  EXPECT_THAT(message_of(with(table_1(), kTeeth, {12, 40})),
              AllOf(HasSubstr("interference"), HasSubstr("pinion's base circle")));
  EXPECT_THAT(message_of(with(table_1(), kTeeth, {40, 12})), HasSubstr("gear's base circle"));
  EXPECT_EQ(message_of(with(table_1(), kTeeth, {17, 40})), "accepted");
}

}  // namespace
}  // namespace gearsweep::testing
