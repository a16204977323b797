// What a model's file says beside its equations: cycles, checks, mirrors and curves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "study/model_file.hpp"
#include "study/study.hpp"
#include "support/folder.hpp"
#include "support/text.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double kTurn = 2.0 * std::numbers::pi;

const std::string kShaft = R"~([model]
name = "shaft"
[states]
x = {}
v = {}
[parameters]
omega = 0.9
teeth = { value = 5, min = 1, max = 100 }
runout = 0.3
lost = 0.2
[constants]
angle = "(phase + 2*pi*turn)/teeth"
k = "if(turn == 2 and phase < 2, 1 - lost, 1)"
[equations]
x = "v"
v = "runout*sin(angle) - 0.1*v - k*x"
[forcing]
period = "2*pi/omega"
cycle = "teeth"
[checks]
"teeth must be a whole number, not {teeth}" = "teeth == floor(teeth)"
)~";

std::string message_of(const std::string& text) {
  try {
    read_model_text(text, "m.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Cycle, IsThePeriodOfTheForcing) {
  const auto model = read_model_text(kShaft, "m.toml");
  const ModelSetting setting = model->default_setting();
  EXPECT_DOUBLE_EQ(model->period(setting), 5.0 * kTurn / 0.9);
  EXPECT_EQ(model->mesh_periods(setting), 5.0);
  const auto point = model->prepare(setting);
  std::vector<double> row(model->phase_coefs.size()), dx(2);
  const std::vector<double> x = {1.0, 0.0};
  for (const double psi : {0.03, 0.24, 0.41, 0.44, 0.5, 0.93}) {
    model->phase_coefs_at(setting, psi, psi, row.data());
    point->rhs(row.data(), x.data(), dx.data());
    const double position = 5.0 * psi;  // in periods of the mesh
    const bool is_soft = position > 2.0 && (position - 2.0) * kTurn < 2.0;
    EXPECT_NEAR(dx[1], 0.3 * std::sin(kTurn * psi) - (is_soft ? 0.8 : 1.0), 1e-14) << psi;
  }
}

TEST(Cycle, BreaksWhereThePhaseBeginsAnewAndWhereATurnDoes) {
  const auto model = read_model_text(kShaft, "m.toml");
  std::vector<double> breaks = model->break_phases(model->default_setting());
  std::ranges::sort(breaks);
  EXPECT_THAT(breaks, ElementsAre(0.0, DoubleNear(0.2, 1e-15), DoubleNear(0.4, 1e-15),
                                  DoubleNear((2.0 + 2.0 / kTurn) / 5.0, 1e-12),
                                  DoubleNear(0.6, 1e-15), DoubleNear(0.8, 1e-15)));
}

TEST(Cycle, MustHoldWholeWaves) {
  const auto model =
      read_model_text(replaced(kShaft, "cycle = \"teeth\"", "cycle = \"7\""), "m.toml");
  ModelSetting setting = model->default_setting();
  EXPECT_THAT(model->check(setting), HasSubstr("has 1.4 waves in a period of the forcing"));
  setting.parameters[static_cast<std::size_t>(model->find_parameter("teeth"))] = 7.0;
  EXPECT_EQ(model->check(setting), "");
}

TEST(Cycle, MustBeWhole) {
  const auto model =
      read_model_text(replaced(kShaft, "cycle = \"teeth\"", "cycle = \"1.5\""), "m.toml");
  EXPECT_THAT(model->check(model->default_setting()), HasSubstr("the cycle is 1.5; it must be a"));
  EXPECT_THAT(message_of(replaced(kShaft, "cycle = \"teeth\"", "cycle = \"x\"")),
              HasSubstr("the cycle may use parameters alone, not 'x'"));
  EXPECT_THAT(message_of(replaced(kShaft, "cycle = \"teeth\"\n", "")),
              HasSubstr("unknown name 'turn'"));
}

TEST(Checks, SayWhatDoesNotHold) {
  const auto model = read_model_text(kShaft, "m.toml");
  ModelSetting setting = model->default_setting();
  EXPECT_EQ(model->check(setting), "");
  setting.parameters[static_cast<std::size_t>(model->find_parameter("teeth"))] = 5.5;
  EXPECT_EQ(model->check(setting), "teeth must be a whole number, not 5.5");
}

TEST(Checks, AreConditionsOfParameters) {
  EXPECT_THAT(message_of(replaced(kShaft, "teeth == floor(teeth)", "x < 1")),
              HasSubstr("a check may use parameters alone, not 'x'"));
  EXPECT_THAT(message_of(replaced(kShaft, "teeth == floor(teeth)", "teeth + 1")),
              HasSubstr("a number stands where a condition is needed"));
}

TEST(Mirrors, NameStatesAndParametersInPairs) {
  const std::string mirrored =
      "name = \"shaft\"\nmirrors = [{ states = \"x v\", parameters = "
      "\"runout lost\" }]";
  const auto model = read_model_text(replaced(kShaft, "name = \"shaft\"", mirrored), "m.toml");
  ASSERT_EQ(model->mirror_pairs.size(), 1U);
  EXPECT_EQ(model->mirror_pairs[0].states[0].second, 1U);
  EXPECT_EQ(model->mirror_pairs[0].parameters[0].first, 2U);
  EXPECT_THAT(message_of(replaced(kShaft, "name = \"shaft\"", replaced(mirrored, "x v", "x w"))),
              HasSubstr("m.toml:3: there is no 'w' to mirror"));
  EXPECT_THAT(message_of(replaced(kShaft, "name = \"shaft\"", replaced(mirrored, "x v", "x"))),
              HasSubstr("must name pairs"));
}

// Otherwise the one that is left out would begin where the model does not.
TEST(Mirrors, BeginMirrored) {
  const std::string mirrored = replaced(kShaft, "name = \"shaft\"",
                                        "name = \"shaft\"\nmirrors = [{ states = \"x v\", "
                                        "parameters = \"runout lost\" }]");
  const auto begins = [&](const std::string& x, const std::string& v) {
    return message_of(replaced(replaced(mirrored, "x = {}", "x = { start = \"" + x + "\" }"),
                               "v = {}", "v = { start = \"" + v + "\" }"));
  };
  EXPECT_EQ(begins("2/runout", "-2/lost"), "accepted");
  EXPECT_THAT(begins("2/runout", "2/lost"), HasSubstr("'x' and 'v' are said to mirror each other"));
  EXPECT_THAT(begins("omega", "0"), HasSubstr("their starts are not shown to"));
}

const std::string kMeasured = R"~([model]
name = "measured"
[states]
x = {}
v = {}
[parameters]
omega = 0.9
k = 2.0
[curves]
stiffness = "of the mesh over its period"
[equations]
x = "v"
v = "cos(phase) - 0.1*v - if(stiffness.given, stiffness(phase), k)*x"
[forcing]
period = "2*pi/omega"
)~";

const std::string kStudy =
    "[[axes]]\nname = 'omega'\nvalues = [0.9]\n[observe]\nquantities = ['x_max']\n";

// The stiffness where x = 1 and the forcing vanishes.
double stiffness_of(const Study& study) {
  const Model& model = *study.model;
  std::vector<double> row(model.phase_coefs.size()), dx(2);
  const std::vector<double> x = {1.0, 0.0};
  model.phase_coefs_at(study.setting, 0.25, 0.25, row.data());
  model.prepare(study.setting)->rhs(row.data(), x.data(), dx.data());
  return -dx[1];
}

TEST(Curves, AreGivenByAStudyAndHeldByIt) {
  const Folder folder;
  folder.write("m.toml", kMeasured);
  folder.write("k.csv", "share, k\n0, 3\n0.5, 5\n");
  const std::string path = (folder / "study.toml").string();
  const std::string model = "[model]\nfile = 'm.toml'\n";
  EXPECT_NEAR(stiffness_of(read_study(model + kStudy, path)), 2.0, 1e-14);
  const std::string given = "[model.curves]\nstiffness = 'k.csv'\n";
  const Study study = read_study(model + given + kStudy, path);
  EXPECT_NEAR(stiffness_of(study), 4.0, 1e-14);
  const Study again = read_study(study.toml, "elsewhere.toml");
  EXPECT_EQ(again.toml, study.toml);
  EXPECT_NEAR(stiffness_of(again), 4.0, 1e-14);
  EXPECT_NEAR(
      stiffness_of(read_study(
          model + replaced(given, "'k.csv'", "{ file = 'k.csv', interpolation = 'linear' }") +
              kStudy,
          path)),
      4.0, 1e-14);
}

TEST(Curves, AreThoseOfTheModel) {
  const Folder folder;
  folder.write("m.toml", kMeasured);
  folder.write("k.csv", "share, k\n0, 3\n0.5, 5\n");
  const auto refusal = [&](const std::string& curves) {
    try {
      read_study("[model]\nfile = 'm.toml'\n[model.curves]\n" + curves + "\n" + kStudy,
                 (folder / "study.toml").string());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal("stifness = 'k.csv'"),
              HasSubstr("unknown curve 'stifness' of model 'measured'; did you mean 'stiffness'?"));
  EXPECT_THAT(refusal("stiffness = 'none.csv'"), HasSubstr("none.csv"));
  EXPECT_THAT(refusal("stiffness = 3"), HasSubstr("the curve 'stiffness' needs a file"));
  EXPECT_THAT(refusal("stiffness = { file = 'k.csv', interpolation = 'steep' }"),
              HasSubstr("steep"));
  EXPECT_THAT(message_of(replaced(kMeasured, "stiffness(phase)", "stiffness(x)")),
              HasSubstr("a table may be read at a phase alone, not at a state 'x'"));
  EXPECT_THAT(message_of(replaced(kMeasured, "stiffness(phase)", "stiffness(phase, 1)")),
              HasSubstr("stiffness() takes 1 argument, not 2"));
}

}  // namespace
}  // namespace gearsweep::testing
