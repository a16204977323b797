// What deviations of the profile add to the error of helical teeth.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gear/drawing_table.hpp"

namespace gearsweep::testing {
namespace {

constexpr double kEps = 1.3;
constexpr double kUm = 50.0;  // the half backlash

// Two gears whose teeth overlap by so many base pitches; 0: spur teeth.
GearConversion pair_with(double overlap, const std::vector<TablePoint>& removed) {
  constexpr double kHelixDeg = 20.0;
  Table table = with(table_1(), kTransmissionError, {0.0});
  table = with(table, kContactRatio, {kEps});
  if (overlap > 0.0) {
    const double sine = std::sin(kHelixDeg * std::numbers::pi / 180.0);
    table = with(table, kHelix, {kHelixDeg});
    table = with(table, kFaceWidth, {overlap * std::numbers::pi * 3.0 / sine});
  }
  GearDrawing drawing = drawing_of(table);
  drawing.set_measured(kProfileFile, {"w.csv", removed, {}});
  return convert_gear(drawing, *find_model("gear5"));
}

// In um: the part with the sine, and that with the cosine.
std::pair<double, double> line(const GearConversion& gear, int order) {
  const std::string place = order == 1 ? "" : "_" + std::to_string(order);
  const double amplitude = kUm * value_of(gear, "e0" + place);
  const double phase = value_of(gear, "e0_phase" + place);
  return {amplitude * std::cos(phase), amplitude * std::sin(phase)};
}

// Relief at both ends of contact, more where it begins.
const std::vector<TablePoint> kRelief = {{0.0, 12.0}, {0.2, 0.0}, {0.8, 0.0}, {1.0, 8.0}};

// By NumPy: sums over 4000 slices at 2048 places, with the load of each slice by the parabola. Its
// sums and their digits are good to 1e-5.
TEST(ProfileError, OfHelicalTeethIsTheMeanOverTheirSlices) {
  const double shorter[3][2] = {
      {1.579595, -0.940658}, {-0.148922, -0.121258}, {0.011577, -0.140408}};
  const double longer[3][2] = {
      {0.467264, -0.221092}, {-0.079947, -0.075808}, {0.008203, -0.017884}};
  const GearConversion first = pair_with(0.4, kRelief), second = pair_with(1.37, kRelief);
  for (int order = 1; order <= 3; ++order) {
    EXPECT_NEAR(line(first, order).first, shorter[order - 1][0], 1e-5) << order;
    EXPECT_NEAR(line(first, order).second, shorter[order - 1][1], 1e-5) << order;
    EXPECT_NEAR(line(second, order).first, longer[order - 1][0], 1e-5) << order;
    EXPECT_NEAR(line(second, order).second, longer[order - 1][1], 1e-5) << order;
  }
}

// At any phase a whole overlap has slices at all places of the path alike.
TEST(ProfileError, OfAWholeOverlapExcitesNothing) {
  for (const double overlap : {1.0, 2.0}) {
    const GearConversion gear = pair_with(overlap, kRelief);
    for (int order = 1; order <= 8; ++order) {
      EXPECT_NEAR(std::hypot(line(gear, order).first, line(gear, order).second), 0.0, 1e-9);
    }
  }
}

// What is the same everywhere turns the gears a little, and excites nothing.
TEST(ProfileError, OfAConstantDeviationIsNone) {
  const GearConversion gear = pair_with(0.4, {{0.0, 5.0}, {1.0, 5.0}});
  EXPECT_NEAR(line(gear, 1).first, 0.0, 1e-9);
  EXPECT_NEAR(line(gear, 1).second, 0.0, 1e-9);
}

// The slices of a tiny overlap stand nearly at one place. Harmonics of the jump where a pair enters
// differ by about pi times order times the overlap.
TEST(ProfileError, OfAVanishingHelixIsThatOfSpurTeeth) {
  const GearConversion spur = pair_with(0.0, kRelief), helical = pair_with(1e-4, kRelief);
  for (int order = 1; order <= 3; ++order) {
    EXPECT_NEAR(line(helical, order).first, line(spur, order).first, 1e-2) << order;
    EXPECT_NEAR(line(helical, order).second, line(spur, order).second, 1e-2) << order;
  }
}

}  // namespace
}  // namespace gearsweep::testing
