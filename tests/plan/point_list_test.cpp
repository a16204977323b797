// A list of points reads as a vector of them would.
#include "plan/point_list.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAreArray;

void expect_list_of(const std::vector<std::size_t>& points) {
  PointList list;
  for (const std::size_t point : points) list.push_back(point);
  ASSERT_EQ(list.size(), points.size());
  EXPECT_EQ(list.empty(), points.empty());
  EXPECT_THAT(std::vector<std::size_t>(list.begin(), list.end()), ElementsAreArray(points));
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(list[i], points[i]) << i;
  if (points.empty()) return;
  EXPECT_EQ(list.front(), points.front());
  EXPECT_EQ(list.back(), points.back());
}

TEST(PointList, GivesBackRunsOfAnySpacing) {
  expect_list_of({});
  expect_list_of({7});
  expect_list_of({3, 4, 5, 13, 14, 15, 23});
  expect_list_of({0, 1000, 2000, 3000, 1, 1001, 2001});
  expect_list_of({9, 6, 3, 0, 4, 4, 4, 99'999'999, 0, 99'999'999});
}

TEST(PointList, GivesBackAnyPoints) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<std::size_t> points(random() % 50);
    for (std::size_t& point : points) point = random() % (round % 2 == 0 ? 6 : 100'000'000);
    if (round % 3 == 0) std::sort(points.begin(), points.end());
    expect_list_of(points);
  }
}

}  // namespace
}  // namespace gearsweep::testing
