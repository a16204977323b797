// The scales of colours: ranges of measures, and classes with names.
#include "plot/detail/scale.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <string>

#include "result/example_result.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::kNaN;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ColourRange, LeavesOutliersOutOnlyWhenTheyTakeTheContrast) {
  std::vector<double> values(2000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i) / 1999.0;
  EXPECT_FALSE(colour_range(values).clipped);
  values[3] = 1e6;
  values[4] = kNaN;
  EXPECT_TRUE(colour_range(values).clipped);
  EXPECT_LE(colour_range(values).max, 1.0);
  const ValueRange constant = colour_range({2.0, 2.0});
  EXPECT_LT(constant.min, 2.0);
  EXPECT_GT(constant.max, 2.0);
}

TEST(ClassScale, AFewWholeNumbersAreClasses) {
  ResultMap map;
  map.values = {1.0, 2.0, 8.0, kNaN, 2.0};
  const auto scale = class_scale(map);
  ASSERT_TRUE(scale.has_value());
  EXPECT_THAT(scale->names, ElementsAre("1", "2", "8"));
  EXPECT_EQ(scale->index_of(8.0), 2.0);
  EXPECT_TRUE(std::isnan(scale->index_of(kNaN)));
  map.values.push_back(0.5);
  EXPECT_FALSE(class_scale(map).has_value());
}

// A map of periods: hundreds of values, but few that matter. Two maps show the same number in the
// same colour, whatever else they hold; none is white, and as far from 1 as can be.
TEST(ClassScale, NumbersHaveTheirColoursAndNoneIsWhite) {
  ResultMap map;
  map.name = "period";
  for (int period = 0; period < 9; ++period) map.values.insert(map.values.end(), 20, period);
  for (int period = 100; period < 115; ++period) map.values.push_back(period);
  const auto scale = class_scale(map);
  ASSERT_TRUE(scale.has_value());
  EXPECT_THAT(scale->names, ElementsAre("1", "2", "3", "4", "5", "6", "7", "8", "> 8", "0"));
  EXPECT_EQ(scale->index_of(8.0), 7.0);
  EXPECT_EQ(scale->index_of(107.0), 8.0);
  EXPECT_EQ(scale->colours.back(), "#ffffff");
  EXPECT_TRUE(std::isnan(scale->index_of(kNaN)));
  EXPECT_EQ(std::set<std::string>(scale->colours.begin(), scale->colours.end()).size(), 10U);
  map.values = {3.0, 12.0};
  EXPECT_EQ(class_scale(map)->colours[0], scale->colours[2]);
  EXPECT_THAT(class_scale(map)->names, ElementsAre("3", "12"));
}

// Sixteen attractors have a colour each; the others share one, and a name that says so.
TEST(ClassScale, NoColourStandsForTwoAttractors) {
  ResultMap map;
  map.name = "attractor";
  map.flags = {"undecided"};
  for (int i = 1; i <= 20; ++i) map.flags.push_back(std::to_string(i) + "_quasi_periodic");
  for (int i = 0; i <= 20; ++i) map.values.push_back(i);
  const auto scale = class_scale(map);
  ASSERT_TRUE(scale.has_value());
  ASSERT_EQ(scale->names.size(), 18U);
  EXPECT_EQ(scale->names[16], "others");
  EXPECT_THAT(scale->names[15], HasSubstr("quasi-periodic"));
  EXPECT_EQ(scale->index_of(17.0), 16.0);
  EXPECT_EQ(scale->index_of(20.0), 16.0);
  EXPECT_EQ(std::set<std::string>(scale->colours.begin(), scale->colours.end()).size(), 18U);
}

TEST(ClassScale, ManyWholeNumbersThatAreNoPeriodsAreShades) {
  ResultMap map;
  map.name = "settled";
  for (int number = 1; number < 200; ++number) map.values.push_back(number);
  EXPECT_FALSE(class_scale(map).has_value());
}

TEST(ClassScale, WithTheKindOfMotionChaosIsToldFromQuasiPeriodicity) {
  ResultMap period, motion;
  period.name = "period";
  period.values = {0.0, 1.0, 0.0, 0.0};
  motion.flags = {"undecided", "periodic", "quasi_periodic", "chaotic"};
  motion.values = {3.0, 1.0, 2.0, 0.0};
  tell_classes_apart(&motion, nullptr, &period);
  EXPECT_THAT(class_scale(period)->names,
              ElementsAre("1", "quasi-periodic", "chaotic", "undecided"));
}

TEST(ClassScale, AttractorsSayWhetherTheyHaveImpacts) {
  ResultMap attractor, contact;
  attractor.name = "attractor";
  attractor.flags = {"undecided", "1_period_1", "2_period_2"};
  attractor.values = {1.0, 2.0, 2.0};
  contact.values = {0.0, 1.0, 1.0};
  tell_classes_apart(nullptr, &contact, &attractor);
  EXPECT_THAT(class_scale(attractor)->names, ElementsAre("attractor 1: period 1, no impacts",
                                                         "attractor 2: period 2, with impacts"));
}

}  // namespace
}  // namespace gearsweep
