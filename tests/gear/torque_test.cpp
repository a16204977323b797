// A torque that swings over the pinion's turn, from a drawing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "gear/drawing_table.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

constexpr double kTurn = 2.0 * std::numbers::pi;

// 61 N m on average; the spline through so many points of a sine is right to 1e-6 of it.
Measured swinging_torque() {
  Measured measured{"t.csv", {}, {}};
  constexpr int kPoints = 90;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = kTurn * i / kPoints;
    measured.points.push_back({angle, 61.0 + 20.0 * std::sin(angle) + 5.0 * std::cos(3.0 * angle)});
  }
  return measured;
}

GearDrawing swinging_drawing(const Table& table, bool has_file) {
  GearDrawing drawing = drawing_of(table);
  if (has_file) drawing.set_measured(kTorqueFile, swinging_torque());
  return drawing;
}

GearConversion converted(const Table& table, bool has_file = true) {
  return convert_gear(swinging_drawing(table, has_file), *find_model("gear5"));
}

TEST(Torque, OfATurnHasItsMeanAsTheLoad) {
  const GearConversion constant = converted(table_1(), false);
  const GearConversion swinging = converted(without(table_1(), kTorque));
  EXPECT_NEAR(value_of(swinging, "F1"), value_of(constant, "F1"), 1e-12);
  // A force on the base circle over k0 b_n, as the load is.
  const double per_torque = value_of(constant, "F1") / 61.0;
  const PeriodicTable& swing = *swinging.curves.at("torque_swing");
  for (const double angle : {0.1, 1.7, 3.3, 5.9}) {
    const double expected = 20.0 * std::sin(angle) + 5.0 * std::cos(3.0 * angle);
    EXPECT_NEAR(swing.at(angle, angle), per_torque * expected, 1e-4 * per_torque) << angle;
  }
  EXPECT_EQ(value_of(swinging, "cycle"), 40.0) << "a turn of the pinion";
  EXPECT_FALSE(has(constant, "cycle"));
}

// What swings stays in N m.
TEST(Torque, BesideAFileIsTheMean) {
  const GearConversion whole = converted(without(table_1(), kTorque));
  const GearConversion light = converted(with(table_1(), kTorque, {30.5}));
  EXPECT_NEAR(value_of(light, "F1"), 0.5 * value_of(whole, "F1"), 1e-12);
  EXPECT_NEAR(light.curves.at("torque_swing")->at(1.0, 1.0),
              whole.curves.at("torque_swing")->at(1.0, 1.0), 1e-12);
  EXPECT_THAT(notes_of(light), HasSubstr("in place of which torque_N_m is 30.5"));
}

TEST(Torque, IsNeededOnce) {
  EXPECT_THAT(message_of(without(table_1(), kTorque)), HasSubstr("[gear] needs 'torque_N_m'"));
}

// A torque that brakes: the mean load of the model is on the drive flank.
TEST(Torque, ThatBrakesIsRefused) {
  GearDrawing drawing = drawing_of(without(table_1(), kTorque));
  drawing.set_measured(kTorqueFile, {"t.csv", {{0.0, -50.0}, {2.0, -60.0}, {4.0, -55.0}}, {}});
  try {
    convert_gear(drawing, *find_model("gear5"));
    FAIL() << "accepted";
  } catch (const DrawingError& error) {
    EXPECT_EQ(error.key(), kTorqueFile.name);
    EXPECT_THAT(error.what(), HasSubstr("out of range"));
  }
}

}  // namespace
}  // namespace gearsweep::testing
