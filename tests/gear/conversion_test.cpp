// What follows from a drawing, against the paper's Table 1, ISO 6336-1 and an unequal pair worked
// out elsewhere. The ranges of parameters are those of gear5.
#include "gear/conversion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gear/detail/transmission_error.hpp"
#include "gear/drawing_table.hpp"
#include "study/builtin_models.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(GearConversion, TableOneOfThePaperGivesThePresetConsistent) {
  const GearConversion gear = convert(with(table_1(), kContactRatio, {1.718}));
  const Model& model = *find_model("gear5");
  for (const char* name : {"b",     "F1", "e0",    "zeta",  "m1", "m2",         "k1",  "k2",
                           "k3",    "k4", "c1",    "c2",    "c3", "c4",         "eps", "approach",
                           "alpha", "A",  "rho_p", "rho_g", "zp", "teeth_ratio"}) {
    const auto index = static_cast<std::size_t>(model.find_parameter(name));
    const double preset = model.parameters[index].default_value;
    // The preset's numbers are rounded to 2 digits (F1, from 61 N m) or more.
    EXPECT_NEAR(value_of(gear, name), preset, 0.005 * preset) << name;
  }
  EXPECT_EQ(gear.parameters.size(), 22U);
}

// mpmath, 30 digits, from the formulas in the header.
TEST(GearConversion, TableOneInAllDigits) {
  const GearConversion gear = convert(table_1());
  expect_value(gear, "m1", 0.350752466540680712);
  expect_value(gear, "m2", 0.350752466540680712);
  expect_value(gear, "zeta", 0.0400809408602008825);
  expect_value(gear, "k1", 1.37994480220791168);
  expect_value(gear, "c4", 2.0);
  expect_value(gear, "A", 2400.0);
  expect_value(gear, "F1", 0.0995321130343922677);
  expect_value(gear, "e0", 0.2);
  // A difference of lengths ten times as great as itself: one digit less.
  EXPECT_NEAR(value_of(gear, "eps"), 1.71353362376776214, 10.0 * kRounding);
  EXPECT_NEAR(gear.scales.varpi, 24895.9901228790640, 24896.0 * kRounding);
  EXPECT_NEAR(gear.scales.rpm_per_omega, 5943.47983683480871, 5943.0 * kRounding);
  EXPECT_DOUBLE_EQ(gear.scales.b_n, 5e-5);
  EXPECT_DOUBLE_EQ(gear.scales.k0, 2.174e8);
  EXPECT_THAT(notes_of(gear), AllOf(HasSubstr("Rp = 56.38156 mm"), HasSubstr("me = 0.350752 kg"),
                                    HasSubstr("Ip/Rp^2 = 0.701505 kg"), HasSubstr("1.71353")));
}

TEST(GearConversion, EqualGearsAreExactlySymmetric) {
  const GearConversion gear = convert(table_1());
  EXPECT_EQ(value_of(gear, "approach"), 0.5);
  EXPECT_EQ(value_of(gear, "rho_p"), 0.5);
  EXPECT_EQ(value_of(gear, "rho_g"), 0.5);
  EXPECT_EQ(value_of(gear, "b"), 1.0);
}

TEST(GearConversion, NotesSayHowANumberCameAbout) {
  const GearConversion gear = convert(table_1());
  EXPECT_EQ(parameter_of(gear, "m1").note, "me/mp = 0.350752 kg / 1 kg");
  EXPECT_EQ(parameter_of(gear, "A").note, "a/b_n = 0.12 m / 5e-05 m");
}

TEST(GearConversion, FaceWidthGivesTheStiffnessOfIso6336) {
  Table table = with(without(table_1(), kMeshStiffness), kFaceWidth, {10});
  table[kContactRatio.name] = {1.718};
  const GearConversion gear = convert(table);
  // c' = 0.78/0.0575655 and c_gamma = c' (0.75 1.718 + 0.25), by hand; 10 mm wide.
  EXPECT_NEAR(gear.scales.k0, 208463402.558824296, 2.1e8 * kRounding);
  EXPECT_THAT(notes_of(gear), AllOf(HasSubstr("q' = 0.0575655"), HasSubstr("c' = 13.5498"),
                                    HasSubstr("c_gamma = 20.8463")));
}

// The second factor of C_B, 1 - 0.02 (20 - alpha_n): 1.05 and 1.1 times the c' of the same teeth at
// 20 degrees, 0.9 times at 15. It takes the pressure angle of the normal section.
TEST(GearConversion, TheStiffnessGrowsWithThePressureAngle) {
  Table table = with(without(table_1(), kMeshStiffness), kFaceWidth, {10});
  table[kContactRatio.name] = {1.5};
  const auto k0 = [](const Table& of) { return convert(of).scales.k0; };
  const auto ratio_at = [&](double degrees) {
    return k0(with(table, kPressureAngle, {degrees})) / k0(table);
  };
  EXPECT_EQ(ratio_at(20.0), 1.0);
  EXPECT_NEAR(ratio_at(22.5), 1.05, kRounding);
  EXPECT_NEAR(ratio_at(25.0), 1.1, kRounding);
  EXPECT_NEAR(ratio_at(15.0), 0.9, kRounding);
  // c' = 0.8 x 0.975 x 1.1 / q' by hand.
  EXPECT_THAT(notes_of(convert(with(table, kPressureAngle, {25}))),
              AllOf(HasSubstr("C_B = 1.0725"), HasSubstr("c' = 14.9048")));
  table[kDedendum.name] = {3.6};
  EXPECT_NEAR(ratio_at(25.0), 1.1, kRounding);
  table[kHelix.name] = {20};
  EXPECT_NEAR(ratio_at(25.0), 1.1, kRounding);
}

TEST(GearConversion, DoubtsWhatIsFarFromAnyGear) {
  EXPECT_THAT(convert(table_1()).doubts, ::testing::IsEmpty());
  EXPECT_THAT(convert(unequal_pair()).doubts, ::testing::IsEmpty());
  const auto doubts = [](const Table& table) { return convert(table).doubts; };
  const auto is_about = [](const GearKey& key, const char* text) {
    return ::testing::Contains(AllOf(::testing::Field(&GearDoubt::key, key.name),
                                     ::testing::Field(&GearDoubt::text, HasSubstr(text))));
  };
  EXPECT_THAT(doubts(with(unequal_pair(), kFaceWidth, {250})),
              is_about(kFaceWidth, "3.12 times the pinion's reference diameter"));
  EXPECT_THAT(doubts(with(unequal_pair(), kMass, {900, 3.2})),
              is_about(kMass, "mass_kg = 900 of the pinion"));
  EXPECT_THAT(doubts(with(table_1(), kMass, {900})), ::testing::Not(::testing::IsEmpty()));
  const Table in_cm2 = with(unequal_pair(), kInertia, {6, 90});
  EXPECT_THAT(doubts(in_cm2), ::testing::SizeIs(2));
  EXPECT_THAT(doubts(with(table_1(), kHalfBacklash, {1})), ::testing::SizeIs(1));
}

// mpmath, 30 digits; the path of contact by coordinates on the line of action (entry, pitch point
// and exit measured from the pinion's base tangent point), not by the two halves used in the code.
TEST(GearConversion, UnequalPairWithUnequalAddenda) {
  const GearConversion gear = convert(unequal_pair());
  EXPECT_NEAR(value_of(gear, "eps"), 1.61936731275455657, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "approach"), 0.469748121726293, 10.0 * kRounding);
  EXPECT_EQ(value_of(gear, "teeth_ratio"), 2.0);
  EXPECT_EQ(value_of(gear, "zp"), 20.0);
  expect_value(gear, "rho_p", 15.0 / 19.0);
  expect_value(gear, "rho_g", 4.0 / 19.0);
  expect_value(gear, "m1", 0.372524451128879680);
  expect_value(gear, "m2", 0.104772501879997410);
  // These go with k0, which has the contact ratio's last digit.
  EXPECT_NEAR(gear.scales.k0, 464714997.970577470, 4.6e8 * 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "zeta"), 0.0200284812291190789, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "k1"), 0.215185652360484622, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "k4"), 0.860742609441938488, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "F1"), 0.214683551435396747, 10.0 * kRounding);
  EXPECT_NEAR(value_of(gear, "omega"), 0.168766082879705092, 10.0 * kRounding);
  expect_value(gear, "c1", 2.0);
  expect_value(gear, "c4", 8.0);
  expect_value(gear, "e0", 0.15);
  expect_value(gear, "A", 3000.0);
}

TEST(GearConversion, SpeedIsOmegaOnlyWhenGiven) {
  EXPECT_FALSE(has(convert(table_1()), "omega"));
  const GearConversion gear = convert(with(table_1(), kSpeed, {1000}));
  expect_value(gear, "omega", 0.168251601326630983);
  expect_value(gear, "omega", 1000.0 / gear.scales.rpm_per_omega);
}

TEST(GearConversion, WithoutMeshDampingThereIsNoBearingDamping) {
  Table table = with(table_1(), kMeshDamping, {0});
  EXPECT_THAT(message_of(table), HasSubstr("c = C/cm"));
  table[kBearingDamping.name] = {0};
  const GearConversion gear = convert(table);
  EXPECT_EQ(value_of(gear, "zeta"), 0.0);
  EXPECT_EQ(value_of(gear, "c1"), 0.0);
}

TEST(GearConversion, BothStiffnessKeysAreOneTooMany) {
  const Table table = with(table_1(), kFaceWidth, {10});
  EXPECT_THAT(message_of(table), AllOf(HasSubstr("face_width_mm: "),
                                       HasSubstr("mesh_stiffness_N_per_m"), HasSubstr("keep one")));
}

std::string options_of(const GearConversion& gear) {
  std::string all;
  for (const GearOption& option : gear.options) all += option.name + " = " + option.choice + "\n";
  return all;
}

TEST(GearConversion, HarmonicsOfTheErrorAreALongList) {
  Table table = with(table_1(), kTransmissionError, {10, 2, 0.5});
  table[kErrorPhase.name] = {0, 90};
  const GearConversion gear = convert(table);
  expect_value(gear, "e0", 0.2);
  expect_value(gear, "e0_2", 0.04);
  expect_value(gear, "e0_3", 0.01);
  expect_value(gear, "e0_phase_2", std::acos(0.0));
  EXPECT_FALSE(has(gear, "e0_4"));
  EXPECT_FALSE(has(gear, "cycle"));
  EXPECT_EQ(options_of(gear), "error = series\n");
  EXPECT_EQ(options_of(convert(table_1())), "");
  EXPECT_THAT(message_of(with(table_1(), kTransmissionError, {1, 2, 3, 4, 5, 6, 7, 8, 9})),
              HasSubstr("has 9 numbers; 1 to 8 is possible"));
  EXPECT_THAT(message_of(with(table_1(), kTransmissionError, {})), HasSubstr("0 numbers"));
  EXPECT_THAT(message_of(with(table_1(), kErrorPhase, {1, 2})),
              HasSubstr("at most one for each harmonic"));
}

// What one gear has comes back once per turn of it; what both have, when the same two teeth meet.
TEST(GearConversion, FaultsChooseTheCycle) {
  const Table pair = with(unequal_pair(), kTeeth, {23, 47});
  const auto cycle = [&](const GearKey& key, const std::vector<double>& values) {
    const GearConversion gear = convert(with(without(pair, kAddendum), key, values));
    return has(gear, "cycle") ? value_of(gear, "cycle") : 1.0;
  };
  EXPECT_EQ(cycle(kRunout, {30, 0}), 23.0);
  EXPECT_EQ(cycle(kRunout, {0, 30}), 47.0);
  EXPECT_EQ(cycle(kRunout, {30}), 1081.0);
  EXPECT_EQ(cycle(kDamage, {0.3, 0}), 23.0);
  EXPECT_EQ(cycle(kDamage, {0, 0.3}), 47.0);
  EXPECT_EQ(cycle(kDamage, {0}), 1.0);
  EXPECT_EQ(cycle(kRunoutPhase, {90}), 1.0);
  const GearConversion gear = convert(with(table_1(), kRunout, {30, 20}));
  EXPECT_EQ(value_of(gear, "cycle"), 40.0);
  expect_value(gear, "runout_p", 0.6);
  expect_value(gear, "runout_g", 0.4);
  EXPECT_EQ(options_of(gear), "error = series\n");
  EXPECT_EQ(options_of(convert(with(table_1(), kDamage, {0.5, 0}))), "");
  EXPECT_THAT(message_of(with(table_1(), kDamage, {1.5})),
              HasSubstr("damage = 1.5 is out of range"));
}

TEST(GearConversion, WhatIsMissingIsNamedWithItsMeaning) {
  for (const auto& [name, values] : table_1()) {
    Table table = table_1();
    table.erase(name);
    EXPECT_THAT(message_of(table), AllOf(HasSubstr("[gear] needs"), HasSubstr(std::string(name))));
  }
}

TEST(GearConversion, NumbersOutOfTheRangeOfTheirKeyMakeNoDrawing) {
  for (const GearKey& key : {kModule, kTorque, kDamage, kTransmissionError, kProfileShift}) {
    for (const double value : {key.min - 1.0, 2.0 * key.max, std::nan("")}) {
      EXPECT_THROW(GearDrawing("gear").set_number(key, value), DrawingError) << key.name << value;
      EXPECT_THROW(GearDrawing("gear").vary(key, value), DrawingError) << key.name << value;
    }
  }
  EXPECT_THROW(GearDrawing("gear").set_numbers(kMass, {1.0, 2.0, 3.0}), DrawingError);
}

// The error that wear adds is shared as gear5 shares loads.
TEST(GearConversion, TheParabolicStiffnessIsThatOfTheModel) {
  const Model& model = *find_model("gear5");
  const auto q = static_cast<std::size_t>(model.find_parameter("q"));
  EXPECT_EQ(model.parameters[q].default_value, kParabolicFall);
}

}  // namespace
}  // namespace gearsweep::testing
