// What a stage's drawing takes of play, thickness of teeth, materials and places, and what it
// tells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "rexs/stage_drawing.hpp"
#include "rexs/unit_text.hpp"
#include "study/imported_gear.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

StageDrawing first_stage(const TextUnit& unit) {
  return stage_drawing(gear_unit_of(read_rexs(xml_of(unit), "unit.rexs")), 0, 0);
}

double half_backlash(const TextUnit& unit) {
  return std::stod(first_stage(unit).keys.at("half_backlash_mm").value);
}

const double kAlpha = 20.0 * std::numbers::pi / 180.0;

TEST(StageDetails, TakeTheNormalOrTransverseBacklash) {
  TextUnit unit = two_stages().unit;
  unit.set("50", "minimum_transverse_backlash", "mm", "0.10");
  unit.set("50", "maximum_transverse_backlash", "mum", "140");
  EXPECT_NEAR(half_backlash(unit), 0.06 * std::cos(kAlpha), 1e-6);
  unit.set("50", "minimum_normal_backlash", "mm", "0.08");
  unit.set("50", "maximum_normal_backlash", "mm", "0.12");
  EXPECT_NEAR(half_backlash(unit), 0.05, 1e-9);
}

// Spans that are shorter by 50 and 70 um on average leave 120 um between the flanks. Axes that are
// 0.1 mm farther apart add 2 sin(alpha) of it, to first order.
TEST(StageDetails, TakeTheDeviationsOfToothThickness) {
  TextUnit unit = two_stages().unit;
  for (const auto& [gear, upper, lower] :
       {std::tuple("20", "-40", "-60"), std::tuple("21", "-50", "-90")}) {
    unit.set(gear, "upper_backlash_allowance_referenced_to_span", "mum", upper);
    unit.set(gear, "lower_backlash_allowance_referenced_to_span", "mum", lower);
  }
  EXPECT_NEAR(half_backlash(unit), 0.06, 1e-6);
  unit.set("50", "center_distance", "mm", "91.6");
  EXPECT_NEAR(half_backlash(unit), 0.06 + 0.1 * std::sin(kAlpha), 2e-4);
  TextUnit chords = two_stages().unit;
  for (const char* gear : {"20", "21"}) {
    chords.set(gear, "chordal_tooth_thickness_upper_deviation", "mm", "-0.05");
    chords.set(gear, "chordal_tooth_thickness_lower_deviation", "mm", "-0.07");
  }
  EXPECT_NEAR(half_backlash(chords), 0.06 * std::cos(kAlpha), 1e-6);
}

// Teeth of half the modulus are half as stiff; a modulus of a thousand steels stands for a rigid
// body.
TEST(StageDetails, TakeTheModuliOfMaterials) {
  UnitBuilder built = two_stages();
  const auto stiffness = [&] {
    const ImportedGear imported = imported_gear_study(first_stage(built.unit), "unit");
    return read_study(imported.toml, "stage.toml").scales.k0;
  };
  const double steel = stiffness();
  built.add("99", "material",
            {{"elastic_modulus", "N / mm^2", "103000"}, {"poisson_ratio", "none", "0.3"}});
  for (const char* gear : {"20", "21"}) {
    built.relate("reference", {{"origin", gear}, {"referenced", "99"}});
  }
  EXPECT_NEAR(stiffness() / steel, 0.5, 1e-5);
  built.unit.set("99", "elastic_modulus", "GPa", "206000");
  EXPECT_NEAR(stiffness() / steel, 1.0, 1e-12);
  EXPECT_THAT(first_stage(built.unit).notes, Contains(HasSubstr("is that of no gear")));
}

TEST(StageDetails, TellWhereCentreDistanceAndShaftsDisagree) {
  TextUnit unit = two_stages().unit;
  EXPECT_THAT(first_stage(unit).notes, Not(Contains(HasSubstr("shafts stand"))));
  unit.set("3", "support_vector", "mm", "[40, 0, 93.5]");
  EXPECT_THAT(first_stage(unit).notes, Contains(HasSubstr("the shafts stand 93.5 mm apart")));
  std::erase_if(unit.at("50").attributes,
                [](const TextAttribute& one) { return one.id == "center_distance"; });
  EXPECT_EQ(first_stage(unit).keys.at("centre_distance_mm").value, "93.5");
}

// Roll angles by tan(arccos(base radius/radius)): the pinion's relief is at the end of the path,
// the gear's at its beginning.
TEST(StageDetails, TakeTheTipReliefOfSpurGears) {
  UnitBuilder built = two_stages();
  built.add("98", "tip_relief",
            {{"tip_relief_depth", "mum", "20"}, {"tip_relief_datum_diameter", "mm", "63.6"}});
  built.add("99", "tip_relief",
            {{"tip_relief_depth", "mm", "0.015"}, {"tip_relief_datum_length", "mm", "2.5"}});
  built.relate("flank_modification", {{"flank", "9220"}, {"modification", "98"}});
  built.relate("flank_modification", {{"flank", "9221"}, {"modification", "99"}});
  const StageDrawing drawing = first_stage(built.unit);
  const double base = 30.0 * std::cos(kAlpha), other = 61.5 * std::cos(kAlpha);
  const auto way = [](double radius, double of) { return of * std::tan(std::acos(of / radius)); };
  const double path = way(33.0, base) + way(64.5, other) - (base + other) * std::tan(kAlpha);
  double share[4] = {}, depth[4] = {};
  const std::string& table = drawing.tables.at("tip-relief.csv");
  ASSERT_EQ(
      std::sscanf(table.c_str(), "share, um\n%lf, %lf\n%lf, %lf\n%lf, %lf\n%lf, %lf", &share[0],
                  &depth[0], &share[1], &depth[1], &share[2], &depth[2], &share[3], &depth[3]),
      8);
  EXPECT_NEAR(share[1], 2.5 / path, 1e-6);
  EXPECT_NEAR(share[2], 1.0 - (way(33.0, base) - way(31.8, base)) / path, 1e-6);
  EXPECT_THAT(depth, ::testing::ElementsAre(15.0, 0.0, 0.0, 20.0));
  const ImportedGear imported = imported_gear_study(drawing, "unit");
  const Study study = read_study(imported.toml, "stage.toml");
  const auto second = static_cast<std::size_t>(study.model->find_parameter("e0_2"));
  EXPECT_GT(study.setting.parameters[second], 0.0);
}

// Helical teeth in the transverse section: the reference circle is wider by 1/cos(beta), the
// tangent of the pressure angle is tan(alpha)/cos(beta).
TEST(StageDetails, TakeTheTipReliefOfHelicalGears) {
  UnitBuilder built = two_stages();
  built.add("98", "tip_relief",
            {{"tip_relief_depth", "mum", "20"}, {"tip_relief_datum_diameter", "mm", "64.2"}});
  built.relate("flank_modification", {{"flank", "9220"}, {"modification", "98"}});
  const double helix = 8.0 * std::numbers::pi / 180.0,
               alpha = std::atan(std::tan(kAlpha) / std::cos(helix));
  const double centre = 91.5 / std::cos(helix);
  built.unit.set("20", "helix_angle_reference_diameter", "deg", "8");
  built.unit.set("21", "helix_angle_reference_diameter", "deg", "-8");
  built.unit.set("50", "center_distance", "mm", fmt::format("{:.12g}", centre));
  const StageDrawing drawing = first_stage(built.unit);
  const double pinion = 30.0 / std::cos(helix), gear = 61.5 / std::cos(helix);
  const double base = pinion * std::cos(alpha), other = gear * std::cos(alpha);
  const auto way = [](double radius, double of) { return std::sqrt(radius * radius - of * of); };
  const double path = way(pinion + 3.0, base) + way(gear + 3.0, other) - centre * std::sin(alpha);
  double share[3] = {}, depth[3] = {};
  ASSERT_EQ(std::sscanf(drawing.tables.at("tip-relief.csv").c_str(),
                        "share, um\n%lf, %lf\n%lf, %lf\n%lf, %lf", &share[0], &depth[0], &share[1],
                        &depth[1], &share[2], &depth[2]),
            6);
  EXPECT_NEAR(share[1], 1.0 - (way(pinion + 3.0, base) - way(32.1, base)) / path, 1e-6);
  EXPECT_THAT(depth, ::testing::ElementsAre(0.0, 0.0, 20.0));
  // The mean over the slices of a pair is smoother than the relief of spur teeth, and not nothing.
  const Study study = read_study(imported_gear_study(drawing, "unit").toml, "stage.toml");
  const auto second = static_cast<std::size_t>(study.model->find_parameter("e0_2"));
  EXPECT_GT(study.setting.parameters[second], 0.0);
}

// Programs may leave out the sign that says which hand it is.
TEST(StageDetails, TellWhereBothHelicesAreOfOneHand) {
  UnitBuilder built = two_stages();
  for (const char* gear : {"20", "21"}) {
    built.unit.set(gear, "helix_angle_reference_diameter", "deg", "8");
  }
  built.unit.set("50", "center_distance", "mm", "92.4");
  const StageDrawing drawing = first_stage(built.unit);
  EXPECT_EQ(drawing.keys.at("helix_angle_deg").value, "8");
  EXPECT_THAT(drawing.notes, Contains(HasSubstr("of one hand")));
}

// A program may say speeds and torques of gears only.
TEST(StageDetails, TakeSpeedsAndTorquesOfGears) {
  TextUnit unit = two_stages().unit;
  std::erase_if(unit.components,
                [](const TextComponent& one) { return one.type == "external_load"; });
  std::erase_if(unit.at("2").attributes,
                [](const TextAttribute& one) { return one.id == "rotational_speed"; });
  unit.set("21", "rotational_speed", "1 / min", "-600");
  unit.set("21", "torque_acting_on_shaft_u", "N m", "-102.5");
  const StageDrawing drawing = first_stage(unit);
  EXPECT_NEAR(drawing.fastest, 1230.0, 1e-9);
  EXPECT_EQ(drawing.keys.at("torque_N_m").value, "50");
}

TEST(StageDetails, TellWhatIsNotTaken) {
  UnitBuilder built = two_stages();
  built.add("99", "tip_relief", {{"tip_relief_depth", "mum", "20"}});
  built.relate("flank_modification", {{"flank", "9220"}, {"modification", "99"}});
  built.unit.set("21", "tooth_thickness_deviation_tolerance_series_din_3967_1978", "", "cd25");
  const StageDrawing drawing = first_stage(built.unit);
  EXPECT_THAT(drawing.notes, Contains(HasSubstr("tip_relief 99 (tip_relief_depth = 20 mum)")));
  EXPECT_THAT(drawing.notes, Contains(HasSubstr("= cd25")));
}

}  // namespace
}  // namespace gearsweep::testing
