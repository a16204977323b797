// The [uncertain] table of a study.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "model/error.hpp"
#include "study/study.hpp"
#include "support/folder.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::SizeIs;

const std::string kAxis = "[[axes]]\nname = 'omega'\nvalues = [0.6, 0.7]\n";

Study read_with(const std::string& uncertain, const std::string& axes = kAxis) {
  return read_study(
      axes + "[observe]\nquantities = ['dmf_max', 'contact_class']\n[uncertain]\n" + uncertain,
      "study.toml");
}

std::string refusal(const std::string& uncertain, const std::string& axes = kAxis) {
  try {
    read_with(uncertain, axes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

std::vector<std::string> quantities_of(const Study& study) {
  std::vector<std::string> names;
  for (const Quantity& quantity : study.selection.quantities) names.push_back(quantity.name);
  return names;
}

TEST(Uncertain, EachQuantityHasMapsOfItsDraws) {
  const Study study = read_with(
      "samples = 20\npercentiles = [2.5, 50]\n"
      "mu = {distribution = 'normal', std = 0.001}\n");
  EXPECT_THAT(quantities_of(study),
              IsSupersetOf({"dmf_max", "dmf_max_sample_mean", "dmf_max_sample_std", "dmf_max_p2_5",
                            "dmf_max_p50", "diverged_share", "contact_class_double_sided_share"}));
  EXPECT_EQ(study.trajectories(), 2U * 21U);
}

TEST(Uncertain, TheValuesInEachDrawAreKeptWhereTheyAreAskedFor) {
  const std::string uncertain =
      "samples = 20\nsobol = true\nmu = {distribution = 'normal', std = 0.001}\n";
  EXPECT_THAT(quantities_of(read_with(uncertain)), Not(Contains("dmf_max_draws")));
  const Study study = read_with("keep = true\n" + uncertain);
  EXPECT_THAT(quantities_of(study), IsSupersetOf({"dmf_max_draws", "contact_class_draws"}));
  const Quantity& kept = study.selection.quantities.back();
  EXPECT_EQ(kept.name, "contact_class_draws");
  EXPECT_EQ(kept.flags.size(), 4U);
  EXPECT_EQ(kept.width, 40U);  // of both of Saltelli's matrices, whose rows are draws
}

TEST(Uncertain, ClosePercentilesKeepNamesOfTheirOwn) {
  const Study study = read_with(
      "samples = 20\npercentiles = [99.99999, 99.999999, 100]\n"
      "mu = {distribution = 'normal', std = 0.001}\n");
  EXPECT_THAT(quantities_of(study),
              IsSupersetOf({"dmf_max_p99_99999", "dmf_max_p99_999999", "dmf_max_p100"}));
}

TEST(Uncertain, TheTextOfAStudyGivesTheSameDraws) {
  const Study study = read_with(
      "samples = 20\nmu = {distribution = 'normal', std = 0.001}\n"
      "b = {distribution = 'uniform', from = 0.9, to = 1.1}\n");
  const Study again = read_study(study.toml, "again");
  ASSERT_THAT(study.uncertain.parameters, SizeIs(2));
  ASSERT_THAT(again.uncertain.parameters, SizeIs(2));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(study.uncertain.parameters[i].draws.values,
              again.uncertain.parameters[i].draws.values);
  }
}

TEST(Uncertain, DrawsDoNotDependOnTheOtherParameters) {
  const std::string mu = "samples = 20\nmu = {distribution = 'normal', std = 0.001}\n";
  const Study alone = read_with(mu);
  const Study both = read_with(mu + "b = {distribution = 'uniform', from = 0.9, to = 1.1}\n");
  const auto of_mu = std::ranges::find(both.uncertain.parameters, "mu",
                                       [](const auto& parameter) { return parameter.draws.name; });
  EXPECT_EQ(alone.uncertain.parameters.front().draws.values, of_mu->draws.values);
}

// Saltelli's scheme has the rows of A, of B, and for each parameter those of A with its column of
// B.
TEST(Uncertain, SobolIndicesTakeTheirMatrices) {
  const Study study = read_with(
      "samples = 8\nsobol = true\n"
      "F1 = {distribution = 'uniform', from = 0.05, to = 0.15}\n"
      "b = {distribution = 'uniform', from = 0.9, to = 1.1}\n");
  const auto draws_of = [&](const std::string& name) {
    return std::ranges::find(study.uncertain.parameters, name,
                             [](const auto& parameter) { return parameter.draws.name; })
        ->draws.values;
  };
  const std::vector<double> load = draws_of("F1"), backlash = draws_of("b");
  ASSERT_THAT(load, SizeIs(8 * 4));
  const auto part = [](const std::vector<double>& values, std::size_t number) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(8 * number);
    return std::vector<double>(begin, begin + 8);
  };
  EXPECT_NE(part(load, 0), part(load, 1));
  EXPECT_EQ(part(load, 2), part(load, 1));
  EXPECT_EQ(part(load, 3), part(load, 0));
  EXPECT_EQ(part(backlash, 2), part(backlash, 0));
  EXPECT_EQ(part(backlash, 3), part(backlash, 1));
}

TEST(Uncertain, AStudyWithoutAxesIsThatOfItsPoint) {
  const Study study =
      read_with("samples = 5\nomega = {distribution = 'normal', std = 0.001}\n", "");
  EXPECT_EQ(study.points(), 1U);
  EXPECT_NE(study.axes.front().name, "omega");
}

TEST(Uncertain, SamplesOfAFileTravelInTheStudy) {
  const Folder folder;
  std::ofstream(folder.path() / "loads.csv") << "# N m\n0.1\n0.2\n0.15\n";
  std::ofstream(folder.path() / "study.toml") << "";
  const Study study = read_study(kAxis + "[uncertain]\nsamples = 40\nF1 = {file = 'loads.csv'}\n",
                                 (folder.path() / "study.toml").string());
  for (const double value : study.uncertain.parameters.front().draws.values) {
    EXPECT_THAT((std::vector{0.1, 0.2, 0.15}), ::testing::Contains(value));
  }
  const Study again = read_study(study.toml, "elsewhere");
  EXPECT_EQ(again.uncertain.parameters.front().draws.values,
            study.uncertain.parameters.front().draws.values);
}

const std::string kGearOfDraws =
    "[gear]\nteeth = [40, 40]\nmodule_mm = 3\ninertia_kg_mm2 = 2230\nmass_kg = 1\n"
    "bearing_stiffness_N_per_mm = 3e5\nbearing_damping_N_s_per_mm = 1.4\n"
    "mesh_damping_N_s_per_mm = 0.7\nhalf_backlash_mm = 0.05\nmesh_stiffness_N_per_m = 2.174e8\n"
    "torque_N_m = 61\ntransmission_error_um = 10\n";

// A key of the drawing gives what [gear] makes of it.
TEST(Uncertain, KeysOfAGearAreDrawnInTheirUnits) {
  const Study study =
      read_with("samples = 10\ntorque_N_m = {distribution = 'uniform', from = 50, to = 70}\n",
                kAxis + kGearOfDraws);
  const Axis& draws = study.uncertain.parameters.front().draws;
  ASSERT_THAT(draws.columns, SizeIs(1));
  EXPECT_EQ(draws.columns.front().name, "F1");
  const double nominal = study.setting.parameters[draws.columns.front().index];
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(draws.columns.front().values[i], nominal * draws.values[i] / 61.0, 1e-12);
  }
}

// An odd gear now and then, beside another key that varies: it has its load, all others have the
// study's. None is among the first hundred.
TEST(Uncertain, RareValuesOfOneOfTwoKeysAreDrawn) {
  const Folder folder;
  std::ofstream samples(folder.path() / "torque.csv");
  samples << "# N m\n122\n";
  for (int i = 0; i < 200; ++i) samples << "61\n";
  samples.close();
  std::ofstream(folder.path() / "study.toml") << "";
  const Study study =
      read_study(kAxis + kGearOfDraws +
                     "[observe]\nquantities = ['dmf_max']\n[uncertain]\nsamples = 600\n"
                     "torque_N_m = {file = 'torque.csv'}\n"
                     "transmission_error_um = {distribution = 'uniform', from = 8, to = 12}\n",
                 (folder.path() / "study.toml").string());
  const auto& all = study.uncertain.parameters;
  const auto torque = std::ranges::find(
      all, "torque_N_m", [](const UncertainParameter& one) { return one.draws.name; });
  ASSERT_NE(torque, all.end());
  const Axis& draws = torque->draws;
  const auto odd = std::ranges::find(draws.values, 122.0);
  ASSERT_NE(odd, draws.values.end());
  ASSERT_GT(odd - draws.values.begin(), 100);
  ASSERT_THAT(draws.columns, SizeIs(1));
  const double nominal = study.setting.parameters[draws.columns.front().index];
  for (std::size_t i = 0; i < draws.values.size(); ++i) {
    EXPECT_NEAR(draws.columns.front().values[i], nominal * draws.values[i] / 61.0, 1e-12);
  }
}

TEST(Uncertain, CurvesAreRefusedWithWhatCanBeDrawn) {
  EXPECT_THAT(refusal("pinion_pitch_error_file = {distribution = 'normal', std = 1}\n"),
              HasSubstr("pinion_runout_um"));
  EXPECT_THAT(refusal("stiffness_file = {distribution = 'normal', std = 1}\n"),
              HasSubstr("one for all draws"));
}

TEST(Uncertain, WhatIsWrongIsTold) {
  EXPECT_THAT(refusal("samples = 20\n"), HasSubstr("names no parameter"));
  EXPECT_THAT(refusal("mu = 3\n"), HasSubstr("mu must be a table"));
  EXPECT_THAT(refusal("nu = {distribution = 'normal', std = 1}\n"), HasSubstr("unknown key 'nu'"));
  EXPECT_THAT(refusal("x1 = {distribution = 'normal', std = 1}\n"), HasSubstr("ensemble"));
  EXPECT_THAT(refusal("mu = {std = 1}\n"), HasSubstr("needs a distribution"));
  EXPECT_THAT(refusal("mu = {distribution = 'normal'}\n"), HasSubstr("needs 'std'"));
  EXPECT_THAT(refusal("mu = {distribution = 'normal', std = 0.1}\n"),
              HasSubstr("out of range; 0 .. 1 is allowed"));
  EXPECT_THAT(refusal("mu = {distribution = 'gamma', std = 0.1}\n"), HasSubstr("triangular"));
  EXPECT_THAT(refusal("b = {distribution = 'uniform', from = 1, to = 1}\n"),
              HasSubstr("'to' must be greater"));
  EXPECT_THAT(refusal("b = {distribution = 'triangular', from = 1, to = 2, mode = 3}\n"),
              HasSubstr("must lie between"));
  EXPECT_THAT(refusal("omega = {distribution = 'normal', std = 0.01}\n"), HasSubstr("relative"));
  EXPECT_THAT(refusal("torque_N_m = {distribution = 'normal', std = 1}\n"), HasSubstr("[gear]"));
  EXPECT_THAT(refusal("percentiles = [50, 5]\nb = {distribution = 'normal', std = 0.01}\n"),
              HasSubstr("must increase"));
  EXPECT_THAT(refusal("b = {file = 'none.csv'}\n"), HasSubstr("none.csv"));
  EXPECT_THAT(refusal("b = {distribution = 'normal', std = 0.01}\n",
                      kAxis + "[initial]\npolicy = 'forward'\n"),
              HasSubstr("goes on from neighbours"));
}

}  // namespace
}  // namespace gearsweep::testing
