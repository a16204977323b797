// Tolerances for a gear that names none, and what one of its draws is.
#include "study/usual_tolerances.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/error.hpp"
#include "study/new_unit.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const std::string kGear =
    "[model]\nname = 'gear5'\n[gear]\nteeth = [19, 61]\nmodule_mm = 2.5\nbody = "
    "'solid'\nface_width_mm = 25\nbearing_stiffness_N_per_mm = 200000\n"
    "bearing_damping_N_s_per_mm = 2\nmesh_damping_ratio = 0.07\nhalf_backlash_mm = 0.0625\n"
    "torque_N_m = 59\ntransmission_error_um = 5\n";
const std::string kToleranceSpeeds =
    "[[axes]]\nname = 'pinion_speed_rpm'\nfrom = 14000\nto = 18000\ncount = 3\n";

std::vector<std::string> names_of(const std::vector<UsualTolerance>& tolerances) {
  std::vector<std::string> names;
  for (const UsualTolerance& one : tolerances) names.push_back(one.name);
  return names;
}

Study study_of(const std::string& toml) { return read_study(toml, "test.toml"); }

// Class 7 by the formulas of ISO 1328-1:2013, with d = 47.5 and 152.5 mm, m = 2.5 mm: slopes of
// 10 um, forms of 13 um, of each gear.
TEST(UsualTolerances, AreThoseOfTheClass) {
  const std::vector<UsualTolerance> tolerances =
      usual_tolerances(study_of(kGear + kToleranceSpeeds), 7);
  EXPECT_THAT(names_of(tolerances),
              ElementsAre("torque_N_m", "transmission_error_um", "mu", "half_backlash_mm",
                          "mesh_damping_ratio", "stiffness_factor", "bearing_stiffness_N_per_mm"));
  const double expected =
      std::sqrt(2.0 * (std::pow(10.0 / 3.0 / std::numbers::pi, 2) + std::pow(13.0 / 6.0, 2)));
  const std::string& error = tolerances[1].distribution;
  EXPECT_NEAR(std::stod(error.substr(error.find("std = ") + 6)), expected, 1e-3);
  EXPECT_THAT(tolerances[1].reason, HasSubstr("class 7"));
}

TEST(UsualTolerances, LeaveOutWhatAnAxisHas) {
  const std::vector<UsualTolerance> tolerances = usual_tolerances(
      study_of(kGear + "[[axes]]\nname = 'torque_N_m'\nfrom = 40\nto = 60\ncount = 3\n"), 7);
  EXPECT_THAT(names_of(tolerances), ::testing::Not(::testing::Contains("torque_N_m")));
}

// Each mesh has its own, and the load is that of the first.
TEST(UsualTolerances, AreThoseOfEachDrawing) {
  const NewUnit row = {GearArrangement::idler, {19, 33, 61}, {2.5, 2.5}, {25.0, 25.0}, {}, 59.0};
  const Study study = study_of(new_unit_study(row));
  const std::vector<UsualTolerance> tolerances = usual_tolerances(study, 7);
  EXPECT_THAT(
      names_of(tolerances),
      ElementsAre("torque_N_m_first", "transmission_error_um_first", "half_backlash_mm_first",
                  "mesh_damping_ratio_first", "stiffness_factor_first",
                  "transmission_error_um_second", "half_backlash_mm_second",
                  "mesh_damping_ratio_second", "stiffness_factor_second"));
  std::vector<std::string> overrides = {"uncertain.samples=3"};
  for (const UsualTolerance& one : tolerances) {
    overrides.push_back(fmt::format("uncertain.{}={}", one.name, one.distribution));
  }
  const Study scattered = read_study(study.toml, "test.toml", overrides);
  // A draw is a study with the numbers of that draw.
  const Study drawn = read_study(study.toml, "test.toml", overrides_of_draw(scattered, 1));
  const auto torque =
      std::ranges::find(scattered.uncertain.parameters, "torque_N_m_first",
                        [](const UncertainParameter& parameter) { return parameter.draws.name; });
  ASSERT_NE(torque, scattered.uncertain.parameters.end());
  const auto datum = std::ranges::find(drawn.gear_data, "torque_N_m", &GearDatum::key);
  EXPECT_NEAR(std::stod(datum->value), torque->draws.values[1], 1e-3);  // told to six digits
}

TEST(UsualTolerances, RefuseWhatTheStandardDoesNotHave) {
  EXPECT_THAT([] { usual_tolerances(study_of(kGear + kToleranceSpeeds), 12); },
              ThrowsMessage<InputError>(HasSubstr("from 1 to 11")));
  EXPECT_THAT(
      [] {
        usual_tolerances(study_of("[model]\npreset = 'coarse'\n" + kToleranceSpeeds.substr(0, 9) +
                                  "name = 'omega'\nfrom = 0.5\nto = 1\ncount = 3\n"),
                         7);
      },
      ThrowsMessage<InputError>(HasSubstr("[uncertain]\n  F1 = {distribution")));
}

TEST(UsualTolerances, CanBeMadeNarrower) {
  const Study study = study_of(
      kGear + kToleranceSpeeds +
      "[uncertain]\nsamples = 4\nmu = {distribution = 'normal', mean = 0.06, std = 0.002}\n"
      "b = {distribution = 'uniform', from = 0.8, to = 1.4, relative = true}\n"
      "zeta = {distribution = 'triangular', from = 0.9, mode = 1.0, to = 1.3, relative = true}\n"
      "alpha = {values = [20.0, 21.0]}\n");
  const auto half = [&](const std::string& name) {
    const std::string entry = scaled_tolerance(study, name, 0.5);
    const Study narrower = read_study(study.toml, "test.toml", {"uncertain." + name + "=" + entry});
    return narrower.uncertain.parameters;
  };
  // The middle of each stays, and each draw is half as far from it.
  for (const auto& [name, middle] :
       {std::pair("mu", 0.06), std::pair("b", 1.1), std::pair("zeta", 1.0)}) {
    const std::vector<UncertainParameter> narrower = half(name);
    for (std::size_t i = 0; i < narrower.size(); ++i) {
      if (narrower[i].draws.name != name) continue;
      for (std::size_t draw = 0; draw < 4; ++draw) {
        EXPECT_NEAR(narrower[i].draws.values[draw] - middle,
                    0.5 * (study.uncertain.parameters[i].draws.values[draw] - middle), 1e-12)
            << name;
      }
    }
  }
  EXPECT_EQ(scaled_tolerance(study, "alpha", 0.5), "");
}

// The study of a draw has its parameters, whether they come from the drawing or not.
TEST(UsualTolerances, TheStudyOfADrawHasItsNumbers) {
  const Study study = study_of(
      kGear + kToleranceSpeeds +
      "[uncertain]\nsamples = 4\ntorque_N_m = {distribution = 'normal', std = 0.05, relative = "
      "true}\nmu = {distribution = 'normal', std = 0.1, relative = true}\n");
  for (std::size_t draw = 0; draw < 4; ++draw) {
    const Study one = read_study(study.toml, "test.toml", overrides_of_draw(study, draw));
    EXPECT_EQ(one.uncertain.draws(), 0U);
    for (const UncertainParameter& parameter : study.uncertain.parameters) {
      for (const Swept& swept : parameter.draws.swept()) {
        const double nominal = parameter.is_factor ? study.setting.parameters[swept.index] : 1.0;
        EXPECT_NEAR(one.setting.parameters[swept.index], nominal * swept.values[draw], 1e-12)
            << swept.name;
      }
    }
  }
}

// Keys of one drawing that change the same parameters, as torque and stiffness the entry of a pair,
// change them together; one of a pair changes alone.
TEST(UsualTolerances, TheStudyOfADrawHasWhatFollowsFromAllItsKeys) {
  const Study study =
      study_of(kGear + "tooth_entry = 'gradual'\nrunout_um = [4, 3]\n" + kToleranceSpeeds +
               "[uncertain]\nsamples = 5\nsobol = true\n"
               "torque_N_m = {distribution = 'normal', std = 0.05, relative = true}\n"
               "mesh_damping_ratio = {distribution = 'uniform', from = 0.04, to = 0.1}\n"
               "stiffness_factor = {distribution = 'uniform', from = 0.7, to = 1.1}\n"
               "gear_runout_um = {distribution = 'uniform', from = 1, to = 9}\n"
               "pinion_runout_um = {distribution = 'uniform', from = 1, to = 9}\n");
  const auto engagement = static_cast<std::size_t>(study.model->find_parameter("engagement"));
  std::size_t given = 0;
  for (std::size_t draw = 0; draw < study.uncertain.draws(); ++draw) {
    const Study one = read_study(study.toml, "test.toml", overrides_of_draw(study, draw));
    std::vector<double> parameters = study.setting.parameters;
    for (const UncertainParameter& parameter : study.uncertain.parameters) {
      for (const Swept& swept : parameter.draws.swept()) {
        parameters[swept.index] = swept.values[draw];
        given += swept.index == engagement ? 1 : 0;
      }
    }
    EXPECT_EQ(one.setting.parameters, parameters) << draw;
  }
  EXPECT_EQ(given, study.uncertain.draws());
}

// Half of the runout is the eccentricity. F_r of class 7 is 0.9 F_p: F_p of class 5 is 0.002 d +
// 0.55 sqrt(d) + 0.7 m + 12 um, two classes are a factor of 2.
TEST(UsualTolerances, HaveTheRunoutOfGearsThatHaveOne) {
  const std::vector<UsualTolerance> tolerances =
      usual_tolerances(study_of(kGear + "runout_um = [4, 0]\n" + kToleranceSpeeds), 7);
  EXPECT_THAT(names_of(tolerances), ::testing::Contains("pinion_runout_um"));
  EXPECT_THAT(names_of(tolerances), ::testing::Not(::testing::Contains("gear_runout_um")));
  const double total = 2.0 * (0.002 * 47.5 + 0.55 * std::sqrt(47.5) + 0.7 * 2.5 + 12.0);
  for (const UsualTolerance& one : tolerances) {
    if (one.name != "pinion_runout_um") continue;
    EXPECT_NEAR(std::stod(one.distribution.substr(one.distribution.find("std = ") + 6)),
                0.9 * total / 6.0, 0.1);  // the standard rounds to 1 um
  }
}

// A speed that scatters is that of the axis times the draw.
TEST(UsualTolerances, TheStudyOfADrawHasItsSpeeds) {
  for (const char* speed : {"omega", "pinion_speed_rpm"}) {
    const bool is_rpm = std::string(speed) != "omega";
    const Study study = study_of(
        kGear +
        (is_rpm ? kToleranceSpeeds : "[[axes]]\nname = 'omega'\nvalues = [0.5, 0.7, 1.1]\n") +
        "[uncertain]\nsamples = 4\nomega = {distribution = 'normal', std = 0.01, relative = "
        "true}\n");
    const Study one = read_study(study.toml, "test.toml", overrides_of_draw(study, 2));
    const double factor = study.uncertain.parameters.front().draws.values[2];
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(one.axes.front().swept().front().values[i],
                  factor * study.axes.front().swept().front().values[i], 1e-12);
    }
  }
}

// An amplitude has no sign.
TEST(UsualTolerances, FoldedDrawsAreNotNegative) {
  const Study study = study_of(kGear + kToleranceSpeeds +
                               "[uncertain]\nsamples = 200\ntransmission_error_um = "
                               "{distribution = 'normal', mean = 0, std = 2, folded = true}\n");
  double sum = 0.0;
  for (const double value : study.uncertain.parameters.front().draws.values) {
    EXPECT_GE(value, 0.0);
    sum += value;
  }
  // The mean of |N(0, 2)| is 2 sqrt(2/pi).
  EXPECT_NEAR(sum / 200.0, 2.0 * std::sqrt(2.0 / std::numbers::pi), 0.25);
}

}  // namespace
}  // namespace gearsweep::testing
