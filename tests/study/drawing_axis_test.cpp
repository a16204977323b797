// Axes over keys of [gear]: each point has the parameters that [gear] gives for its value.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/refusal.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

// An unequal pair. The mesh stiffness is given, so that geometry does not change it.
const char* const kDrawing =
    "[gear]\nteeth = [20, 40]\nmodule_mm = 4.0\naddendum_mm = [4.5, 3.5]\n"
    "inertia_kg_mm2 = [600, 9000]\nmass_kg = [0.9, 3.2]\n"
    "bearing_stiffness_N_per_mm = [1e5, 2e5, 3e5, 4e5]\n"
    "bearing_damping_N_s_per_mm = [1.0, 2.0, 3.0, 4.0]\nmesh_damping_N_s_per_mm = 0.5\n"
    "half_backlash_mm = 0.04\nmesh_stiffness_N_per_m = 3e8\ntorque_N_m = 150\n"
    "transmission_error_um = 6\n";

std::string axis_over(const std::string& key, const std::string& values) {
  return fmt::format("[[axes]]\nname = '{}'\nvalues = [{}]\n", key, values);
}

const std::string kSpeeds = axis_over("omega", "0.5, 0.7");

TEST(DrawingAxis, PointsHaveWhatTheTableGivesForTheirValues) {
  const std::pair<std::string, std::string> keys[] = {{"torque_N_m", "50, 150, 400"},
                                                      {"transmission_error_um", "0, 6, 30"},
                                                      {"pinion_speed_rpm", "500, 3000, 12000"},
                                                      {"mass_kg", "0.5, 1, 4"},
                                                      {"bearing_stiffness_N_per_mm", "1e5, 4e5"},
                                                      {"bearing_damping_N_s_per_mm", "0, 2"},
                                                      {"mesh_damping_N_s_per_mm", "0.2, 0.5, 1.1"},
                                                      {"addendum_mm", "3.6, 4"},
                                                      {"contact_ratio", "1.2, 1.6"},
                                                      {"centre_distance_mm", "120, 120.3"}};
  for (const auto& [key, values] : keys) {
    const Study swept = read_study(kDrawing + axis_over(key, values), "s.toml");
    EXPECT_EQ(swept.axes[0].name, key);
    for (std::size_t point = 0; point < swept.points(); ++point) {
      const double value = swept.axes[0].values[point];
      const Study given =
          read_study(kDrawing + kSpeeds, "g.toml", {fmt::format("gear.{}={}", key, value)});
      std::vector<double> parameters = swept.setting.parameters;
      for (const Swept* one : swept.swept()) parameters[one->index] = one->values[point];
      EXPECT_EQ(parameters, given.setting.parameters) << key << " " << value;
      EXPECT_EQ(swept.scales.varpi, given.scales.varpi) << key;
    }
  }
}

// The other one of the pair stays.
TEST(DrawingAxis, OneOfAPairVaries) {
  for (const auto& [key, first, second] : {std::tuple("pinion_mass_kg", "[2.5, 3.2]", "[1.0, 3.2]"),
                                           std::tuple("gear_mass_kg", "[0.9, 2.5]", "[0.9, 1.0]"),
                                           std::tuple("gear_runout_um", "[0, 2.5]", "[0, 1.0]")}) {
    const std::string name = std::string(key).substr(std::string(key).find('_') + 1);
    const Study swept = read_study(kDrawing + axis_over(key, "1.0, 2.5"), "s.toml");
    for (std::size_t point = 0; point < 2; ++point) {
      const Study given =
          read_study(kDrawing + kSpeeds, "g.toml",
                     {fmt::format("gear.{}={}", name, point == 0 ? second : first)});
      std::vector<double> parameters = swept.setting.parameters;
      for (const Swept* one : swept.swept()) parameters[one->index] = one->values[point];
      EXPECT_EQ(parameters, given.setting.parameters) << key;
    }
  }
}

TEST(DrawingAxis, MayGiveWhatTheTableLacks) {
  std::string drawing = kDrawing;
  drawing.erase(drawing.find("torque_N_m"), std::string("torque_N_m = 150\n").size());
  const Study study = read_study(drawing + axis_over("torque_N_m", "50, 150"), "s.toml");
  EXPECT_EQ(study.axes[0].unit, "N m");
  EXPECT_EQ(study.points(), 2U);
  EXPECT_EQ(read_study(study.toml, "again").toml, study.toml);
}

TEST(DrawingAxis, MayStandBesideAnotherThatGivesOtherParameters) {
  const Study study = read_study(kDrawing + axis_over("pinion_speed_rpm", "500, 3000") +
                                     axis_over("torque_N_m", "50, 150, 400"),
                                 "s.toml");
  EXPECT_EQ(study.points(), 6U);
  EXPECT_THAT(refusal(kDrawing + kSpeeds + axis_over("pinion_speed_rpm", "500, 3000")),
              HasSubstr("the axes 'omega' and 'pinion_speed_rpm' both give omega"));
  EXPECT_THAT(refusal(kDrawing + axis_over("mesh_damping_N_s_per_mm", "0.2, 0.5") +
                      axis_over("bearing_damping_N_s_per_mm", "1, 2")),
              HasSubstr("both give c1"));
}

TEST(DrawingAxis, IsRefusedWhereTheResultWouldChangeItsUnits) {
  for (const char* key : {"module_mm", "inertia_kg_mm2"}) {
    EXPECT_THAT(refusal(kDrawing + axis_over(key, "4.0, 4.1")), HasSubstr("measured in")) << key;
  }
  EXPECT_THAT(refusal(kDrawing + axis_over("teeth", "20, 21")), HasSubstr("axis 'teeth'"));
}

// The half backlash of the table stays the unit of length, so that b alone differs.
TEST(DrawingAxis, OfTheHalfBacklashIsOneOfB) {
  const Study swept = read_study(kDrawing + axis_over("half_backlash_mm", "0.02, 0.06"), "s.toml");
  ASSERT_NE(swept.axes[0].find_column("b"), nullptr);
  for (const Swept& column : swept.axes[0].columns) {
    if (column.name == "b") {
      EXPECT_THAT(column.values, ::testing::ElementsAre(0.5, 1.5));
    } else {
      EXPECT_EQ(column.values[0], column.values[1]) << column.name;
    }
  }
  EXPECT_EQ(swept.scales, read_study(kDrawing + kSpeeds, "s.toml").scales);
  // 2 % of the table's 0.04 mm.
  const Study uncertain =
      read_study(kDrawing + kSpeeds +
                     "[uncertain]\nsamples = 4\nhalf_backlash_mm = {distribution = "
                     "'uniform', from = 0.0392, to = 0.0408}\n",
                 "s.toml");
  const Axis& draws = uncertain.uncertain.parameters[0].draws;
  const Swept& b = *draws.find_column("b");
  for (std::size_t i = 0; i < draws.values.size(); ++i) {
    EXPECT_DOUBLE_EQ(b.values[i], draws.values[i] / 0.04);
  }
}

TEST(DrawingAxis, OfAnotherNameIsToldTheKey) {
  EXPECT_THAT(refusal(kDrawing + axis_over("speed_rpm", "500, 3000")),
              HasSubstr("did you mean 'pinion_speed_rpm'?"));
}

TEST(DrawingAxis, IsNoneWhereAModelHasAParameterOfThatName) {
  const Study study = read_study(
      "[model]\ntext = '''\n[model]\nname = \"own\"\n[states]\nx = {}\n[parameters]\n"
      "mass_kg = 1.0\n[equations]\nx = \"-x/mass_kg + cos(phase)\"\n[forcing]\nperiod = "
      "\"1\"\n'''\n" +
          axis_over("mass_kg", "0.5, 2"),
      "s.toml");
  EXPECT_TRUE(study.axes[0].columns.empty());
  EXPECT_THAT(study.axes[0].values, ::testing::ElementsAre(0.5, 2.0));
}

TEST(DrawingAxis, IsRefusedWithItsPlace) {
  EXPECT_THAT(refusal(axis_over("torque_N_m", "50, 150")), HasSubstr("no such table"));
  EXPECT_THAT(refusal(kDrawing + axis_over("torque_N_m", "-50, 150")), HasSubstr("out of range"));
  EXPECT_THAT(refusal(kDrawing + axis_over("contact_ratio", "1.2, 9")),
              ::testing::AllOf(HasSubstr("s.toml:14"), HasSubstr("contact_ratio = 9")));
}

}  // namespace
}  // namespace gearsweep::testing
