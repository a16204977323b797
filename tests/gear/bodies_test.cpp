// What a drawing lacks, and what stands for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gear/drawing_table.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::map<std::string_view, std::string> kSolid = {{kBody.name, "solid"}};

// 20 and 40 teeth of module 4: discs of 80 and 160 mm, 25 mm wide.
TEST(GearBodies, OfSteelDiscs) {
  Table drawing = without(without(unequal_pair(), kMass), kInertia);
  const GearConversion gear = convert(drawing, kSolid);
  const double width = 0.025, density = 7850.0;
  const double mass_p = density * std::numbers::pi * 0.04 * 0.04 * width;
  const double mass_g = density * std::numbers::pi * 0.08 * 0.08 * width;
  const double inertia_p = 0.5 * mass_p * 0.04 * 0.04, inertia_g = 0.5 * mass_g * 0.08 * 0.08;
  const GearConversion given = convert(
      with(with(drawing, kMass, {mass_p, mass_g}), kInertia, {inertia_p * 1e6, inertia_g * 1e6}));
  for (const GearParameter& parameter : given.parameters) {
    EXPECT_NEAR(value_of(gear, parameter.name), parameter.value, 1e-12 * std::abs(parameter.value))
        << parameter.name;
  }
  EXPECT_THAT(notes_of(gear),
              AllOf(HasSubstr("an estimate: steel discs"), HasSubstr("mass: 0.98")));
  EXPECT_THAT(notes_of(given), Not(HasSubstr("an estimate")));
}

// What is given is taken; a bore makes a ring.
TEST(GearBodies, OfRingsWithGivenMasses) {
  const Table drawing = with(without(unequal_pair(), kInertia), kBore, {30, 40});
  const GearConversion gear = convert(drawing, kSolid);
  const auto ring = [](double outer, double inner) {  // kg mm^2
    return 7.85e-6 * std::numbers::pi * 25.0 * (std::pow(outer, 4) - std::pow(inner, 4)) / 2.0;
  };
  const double pinion = ring(40.0, 15.0), wheel = ring(80.0, 20.0);
  EXPECT_NEAR(value_of(gear, "rho_g") / value_of(gear, "rho_p"), 4.0 * pinion / wheel, 1e-12);
  const GearConversion given = convert(with(without(drawing, kBore), kInertia, {pinion, wheel}));
  EXPECT_NEAR(value_of(gear, "m2"), value_of(given, "m2"), 1e-12);
}

TEST(GearBodies, RefuseWhatMakesNoSense) {
  const Table pair = unequal_pair();
  EXPECT_THAT(message_of(pair, kSolid), HasSubstr("nothing left to estimate"));
  EXPECT_THAT(message_of(with(pair, kBore, {10})), HasSubstr("bore_mm is that of body"));
  EXPECT_THAT(message_of(with(without(pair, kInertia), kBore, {80, 10}), kSolid),
              HasSubstr("leaves nothing of its reference diameter, 80 mm"));
  const Table stiff = with(without(without(pair, kFaceWidth), kInertia), kMeshStiffness, {2e8});
  EXPECT_THAT(message_of(stiff, kSolid), HasSubstr("needs 'face_width_mm'"));
  EXPECT_EQ(message_of(with(stiff, kFaceWidth, {25}), kSolid), "accepted");
}

// gear5 damps in two pairs of teeth, so each has half of the mesh's damping.
TEST(MeshDamping, IsARatio) {
  const GearConversion ratio =
      convert(with(without(unequal_pair(), kMeshDamping), kDampingRatio, {0.07}));
  EXPECT_EQ(value_of(ratio, "zeta"), 0.035);
  const double critical = 0.5e3 / value_of(convert(unequal_pair()), "zeta");  // N s/m
  EXPECT_NEAR(value_of(ratio, "c2"), 2.0e3 / (0.035 * critical), 1e-12);
  EXPECT_THAT(message_of(with(unequal_pair(), kDampingRatio, {0.07})), HasSubstr("give one"));
}

TEST(MissingKeys, AreToldAtOnceWithWhereToGetThem) {
  const Table bare = {{kTeeth.name, {19, 61}}, {kModule.name, {2.5}}};
  EXPECT_THAT(message_of(bare),
              AllOf(HasSubstr("[gear] needs 9 more keys:\n  'inertia_kg_mm2'"),
                    HasSubstr("\n  'mass_kg' (mass): from CAD, or body = \"solid\""),
                    HasSubstr("\n  'bearing_stiffness_N_per_mm'"),
                    HasSubstr("\n  'bearing_damping_N_s_per_mm'"),
                    HasSubstr("\n  'mesh_damping_N_s_per_mm' (mesh damping, of each of the two "
                              "pairs that gear5 has "
                              "at all times): measured, or "
                              "mesh_damping_ratio = 0.07"),
                    HasSubstr("\n  'half_backlash_mm'"), HasSubstr("\n  'face_width_mm'"),
                    HasSubstr("\n  'torque_N_m'"), HasSubstr("\n  'transmission_error_um'")));
  EXPECT_THAT(message_of(bare, kSolid), Not(HasSubstr("'mass_kg'")));
  EXPECT_THAT(message_of(without(table_1(), kTorque)),
              HasSubstr("[gear] needs 'torque_N_m' (torque on the pinion): 9549 times"));
}

const GearDatum& datum_of(const GearConversion& gear, const GearKey& key) {
  return *std::ranges::find(gear.data, key.name, &GearDatum::key);
}

TEST(GearData, SayWhatWasGivenAndWhatWasNot) {
  const GearConversion gear = convert(unequal_pair());
  EXPECT_EQ(datum_of(gear, kMass).value, "0.9, 3.2");
  EXPECT_EQ(datum_of(gear, kMass).origin, DatumOrigin::given);
  EXPECT_EQ(datum_of(gear, kPressureAngle).value, "20");
  EXPECT_EQ(datum_of(gear, kPressureAngle).origin, DatumOrigin::by_default);
  EXPECT_EQ(datum_of(gear, kCentreDistance).value, "120");  // 4 mm (20 + 40)/2
  EXPECT_EQ(datum_of(gear, kCentreDistance).origin, DatumOrigin::by_default);
}

// A ratio stands for what nobody measured; k0 by the standard does, too.
TEST(GearData, CallAnEstimateOne) {
  const Table table = with(
      with(without(without(unequal_pair(), kMeshDamping), kMeshStiffness), kDampingRatio, {0.07}),
      kFaceWidth, {20});
  const GearConversion gear = convert(table);
  EXPECT_EQ(datum_of(gear, kDampingRatio).origin, DatumOrigin::estimated);
  EXPECT_EQ(datum_of(gear, kMeshStiffness).origin, DatumOrigin::estimated);
  EXPECT_NEAR(std::stod(datum_of(gear, kMeshStiffness).value), gear.scales.k0,
              1e-5 * gear.scales.k0);  // six digits
  EXPECT_EQ(datum_of(gear, kFaceWidth).origin, DatumOrigin::given);
}

}  // namespace
}  // namespace gearsweep::testing
