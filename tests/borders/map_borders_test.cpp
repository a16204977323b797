// Borders of a map are the stretches of its pixels' edges between two periods.
#include "borders/map_borders.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "borders/curve_distance.hpp"

namespace gearsweep::testing {
namespace {

// Rows from the lowest; '.' has no period.
PeriodPixels pixels_of(const std::vector<std::string>& rows) {
  PeriodPixels pixels;
  for (std::size_t i = 0; i < rows.front().size(); ++i)
    pixels.axes[0].push_back(static_cast<double>(i));
  for (std::size_t i = 0; i < rows.size(); ++i)
    pixels.axes[1].push_back(10.0 * static_cast<double>(i));
  for (const std::string& row : rows) {
    for (const char letter : row)
      pixels.period.push_back(letter == '.' ? std::nan("") : letter - '0');
  }
  return pixels;
}

TEST(MapBorders, AreToldApartByTheirPeriods) {
  const auto borders = find_map_borders(pixels_of({"1122", "1122", "1144", "1144"}), 1);
  ASSERT_EQ(borders.size(), 3U);
  for (const MapBorder& border : borders) {
    EXPECT_EQ(border.edges.size(), 2U) << border.labels[0] << border.labels[1];
  }
}

TEST(MapBorders, ThatDoNotHangTogetherAreTwo) {
  const auto borders = find_map_borders(pixels_of({"1.....1", "1.....1"}), 1);
  ASSERT_EQ(borders.size(), 2U);
  EXPECT_EQ(borders[0].labels, (std::array{0, 1}));
  EXPECT_EQ(borders[0].edges.size(), 2U);
}

TEST(MapBorders, ThatAreShorterThanAskedAreLeftOut) {
  EXPECT_TRUE(find_map_borders(pixels_of({"112", "112"}), 3).empty());
  EXPECT_EQ(find_map_borders(pixels_of({"112", "112"}), 2).size(), 1U);
}

TEST(MapBorders, OfMotionsWithoutAPeriodAreNone) {
  EXPECT_TRUE(find_map_borders(pixels_of({"...", "..."}), 1).empty());
}

// Neighbours are one pixel apart, whatever their values are.
TEST(PixelPlaces, FollowAnAxisOfAnySpacing) {
  PeriodPixels pixels;
  pixels.axes = {{{0.8, 1.0, 1.1, 1.5}, {1.0, 10.0, 1000.0}}};
  pixels.is_logarithmic = {false, true};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(pixel_place(pixels, {pixels.axes[0][i], 1.0})[0], static_cast<double>(i), 1e-12);
  }
  EXPECT_NEAR(pixel_place(pixels, {1.05, 1.0})[0], 1.5, 1e-12);
  EXPECT_NEAR(pixel_place(pixels, {1.9, 1.0})[0], 4.0, 1e-12);
  EXPECT_NEAR(pixel_place(pixels, {1.0, 100.0})[1], 1.5, 1e-12);
}

}  // namespace
}  // namespace gearsweep::testing
