// Peaks: one point for each, apart from each other, in any number of axes.
#include "result/peaks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace gearsweep {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

ResultMap map_of(const std::vector<std::size_t>& sizes, const std::vector<double>& values) {
  ResultMap map;
  for (const std::size_t size : sizes) {
    ResultAxis axis;
    for (std::size_t i = 0; i < size; ++i) axis.values.push_back(static_cast<double>(i));
    map.axes.push_back(axis);
  }
  map.values = values;
  return map;
}

std::vector<std::size_t> points(const ResultMap& map, std::size_t count, bool smallest = false,
                                double apart = 0.0) {
  std::vector<std::size_t> points;
  for (const Peak& peak : find_peaks(map, {count, smallest, apart})) points.push_back(peak.point);
  return points;
}

TEST(Peaks, AreLocalExtremesTheGreatestFirst) {
  const ResultMap line = map_of({9}, {0, 3, 1, 0, 5, 4, 4.5, 1, 2});
  EXPECT_THAT(points(line, 9), ElementsAre(4, 6, 1, 8));
  EXPECT_THAT(points(line, 2), ElementsAre(4, 6));
  EXPECT_THAT(points(line, 9, true), ElementsAre(0, 3, 7, 5));
}

// 4.5 at 6 is a local extreme, but only two values from 5 at 4.
TEST(Peaks, AreApart) {
  const ResultMap line = map_of({9}, {0, 3, 1, 0, 5, 4, 4.5, 1, 2});
  EXPECT_THAT(points(line, 9, false, 0.34), ElementsAre(4, 8)) << "four values, at least";
  EXPECT_THAT(points(line, 9, false, 1.0), ElementsAre(4));
  EXPECT_EQ(steps_apart(line.axes[0], 0.0), 2U);
  EXPECT_EQ(steps_apart(line.axes[0], 0.34), 4U);
}

TEST(Peaks, ArePointsThatNoNeighbourExceedsDiagonalsIncluded) {
  const ResultMap map = map_of({4, 3}, {1, 0, 0, 0,  //
                                        0, 2, 0, 0,  //
                                        0, 0, 0, 3});
  EXPECT_THAT(points(map, 9), ElementsAre(11, 5));
  const std::vector<Peak> peaks = find_peaks(map, {.count = 9, .smallest = false, .apart = 0.0});
  EXPECT_THAT(peaks[1].places, ElementsAre(1, 1));
  EXPECT_EQ(peaks[1].value, 2.0);
  EXPECT_TRUE(peaks[0].at_edge);
  EXPECT_FALSE(peaks[1].at_edge);
}

TEST(Peaks, APlateauIsOneByTheMiddleOfIt) {
  EXPECT_THAT(points(map_of({7}, {0, 2, 2, 2, 1, 1, 1}), 9), ElementsAre(2));
  EXPECT_THAT(points(map_of({3, 3}, {1, 1, 1, 1, 1, 1, 1, 1, 1}), 9), ElementsAre(4));
  EXPECT_THAT(points(map_of({4}, {1, 1, 1, 1}), 9), ElementsAre(1)) << "the first of two middles";
}

TEST(Peaks, PointsWithoutAValueAreNone) {
  EXPECT_THAT(points(map_of({5}, {kNone, 1, kNone, 2, 1}), 9), ElementsAre(3, 1));
  EXPECT_THAT(points(map_of({2}, {kNone, kNone}), 9), IsEmpty());
}

TEST(Peaks, EqualOnesAreInTheOrderOfThePoints) {
  EXPECT_THAT(points(map_of({5}, {2, 0, 2, 0, 2}), 9), ElementsAre(0, 2, 4));
}

TEST(Peaks, APointOfAListHasNoNeighbours) {
  ResultMap list = map_of({4}, {1, 4, 3, 2});
  list.axes[0].name = kPointAxis;
  EXPECT_THAT(points(list, 3, false, 0.5), ElementsAre(1, 2, 3));
  EXPECT_FALSE(find_peaks(list, {.count = 4, .smallest = false, .apart = 0.5})[3].at_edge);
}

TEST(Peaks, ThreeAxesAndASinglePointDoToo) {
  std::vector<double> values(27, 0.0);
  values[13] = 1.0;
  values[26] = 0.5;  // a neighbour of 13
  EXPECT_THAT(points(map_of({3, 3, 3}, values), 9), ElementsAre(13));
  EXPECT_THAT(points(map_of({1}, {7}), 9), ElementsAre(0));
  EXPECT_FALSE(
      find_peaks(map_of({1}, {7}), {.count = 1, .smallest = false, .apart = 0.0}).front().at_edge);
}

}  // namespace
}  // namespace gearsweep
