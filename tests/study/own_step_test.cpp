// The step that a study finds for a model that names none: what it is for systems whose step was
// measured, and what it must not depend on.
#include "study/own_step.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "study/builtin_models.hpp"
#include "study/settings.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

struct System {
  std::string name;
  std::vector<std::pair<std::string, std::string>> equations;  // state, its rate
  std::vector<double> start;
  std::string parameter;
  double from = 0.0, to = 1.0;
  std::string period = "1";
};

const System kLorenz = {"own_lorenz",
                        {{"x", "10*(y - x)"}, {"y", "x*(rho - z) - y"}, {"z", "x*y - 8/3*z"}},
                        {1.0, 1.0, 1.0},
                        "rho",
                        28.0,
                        32.0};
const System kBrusselator = {"own_brusselator",
                             {{"x", "1 - (b + 1)*x + x^2*y"}, {"y", "b*x - x^2*y"}},
                             {1.0, 1.0},
                             "b",
                             3.0,
                             3.5};
const System kDuffing = {"own_duffing", {{"x", "v"}, {"v", "7.5*sin(phase) - 0.05*v - x^3"}},
                         {0.0, 0.0},    "omega",
                         0.9,           1.1,
                         "2*pi/omega"};

// In other units: a unit of the new time is 1/time of the old one, and so of lengths. Each state of
// the new system is its old one times `length`, plus `offset`.
Study study_of(const System& system, double time = 1.0, double length = 1.0, double offset = 0.0) {
  std::string states, constants, equations;
  for (std::size_t i = 0; i < system.equations.size(); ++i) {
    const auto& [state, rate] = system.equations[i];
    states += fmt::format("{}_ = {{ start = \"{}\" }}\n", state, system.start[i] * length + offset);
    constants += fmt::format("{0} = \"({0}_ - ({1}))/{2}\"\n", state, offset, length);
    equations += fmt::format("{}_ = \"({})*{}\"\n", state, rate, length / time);
  }
  const std::string model = fmt::format(
      "[model]\nname = \"{}\"\n[states]\n{}[parameters]\n{} = {}\n[constants]\n{}[equations]\n{}"
      "[forcing]\nperiod = \"({})*{}\"\n",
      system.name, states, system.parameter, system.from, constants, equations, system.period,
      time);
  return read_study(
      fmt::format("[model]\ntext = '''\n{}'''\n[[axes]]\nname = '{}'\nfrom = {}\nto = {}\ncount = "
                  "9\n",
                  model, system.parameter, system.from, system.to),
      "own_step_test");
}

double step_of(const System& system, double time = 1.0, double length = 1.0, double offset = 0.0) {
  return study_of(system, time, length, offset).integrate.max_step;
}

// As long as what the built-in models of these equations name, which was measured by exponents at
// shorter steps, to within a factor of three.
TEST(OwnStep, IsWhatWasMeasuredOfKnownSystems) {
  for (const char* name : {"lorenz", "rossler", "duffing", "vanderpol", "chua"}) {
    std::string text = *model_text(name);
    const std::size_t key = text.find("\nmax_step");
    ASSERT_NE(key, std::string::npos) << name;
    text.erase(key, text.find('\n', key + 1) - key);
    const Model& known = *find_model(name);
    // Off the equilibrium at 0, where most of them rest.
    const Study study =
        read_study(fmt::format("[model]\ntext = '''\n{}'''\n[[axes]]\nname = '{}'\nvalues = [{}]\n",
                               text, known.states.front().name, 1.0),
                   "own_step_test");
    EXPECT_EQ(study.model->max_step, 0.0);
    EXPECT_GT(study.integrate.max_step, known.max_step / 3.0) << name;
    EXPECT_LT(study.integrate.max_step, known.max_step * 3.0) << name;
  }
}

// Powers of two change no rounding, so that even chaos stays the same; others do.
TEST(OwnStep, ScalesWithTheUnitOfTimeAndNotOfLength) {
  for (const System& system : {kLorenz, kBrusselator, kDuffing}) {
    const double own = step_of(system);
    EXPECT_EQ(step_of(system, 0x1p-20), own * 0x1p-20) << system.name;
    EXPECT_EQ(step_of(system, 0x1p17, 0x1p-30), own * 0x1p17) << system.name;
  }
  const double own = step_of(kBrusselator);
  EXPECT_NEAR(step_of(kBrusselator, 1e-6, 1e9), own * 1e-6, own * 1e-15);
  EXPECT_NEAR(step_of(kBrusselator, 86400.0, 1e-9), own * 86400.0, own * 1e-4);
  EXPECT_NEAR(step_of(kBrusselator, 1.0, 1.0, 1000.0), own, own * 1e-9);
}

// The period of a model without forcing is a clock, which rounds the step by less than a quarter.
TEST(OwnStep, DoesNotDependOnTheClockOfAnAutonomousModel) {
  const double own = step_of(kBrusselator);
  for (const char* period : {"0.001", "0.3", "70"}) {
    System other = kBrusselator;
    other.period = period;
    EXPECT_NEAR(step_of(other), own, 0.25 * own) << period;
  }
}

// A damped oscillator of 1500 Hz in seconds: some 40 steps for each of its periods, and 16 or more
// for each of the forcing.
TEST(OwnStep, IsRightForAnOscillatorInSeconds) {
  const System system = {
      "own_tuned", {{"x", "v"}, {"v", "cos(phase) - 2*0.01*2*pi*1500*v - (2*pi*1500)^2*x"}},
      {0.0, 0.0},  "f",
      500.0,       3000.0,
      "1/f"};
  const double step = step_of(system);
  EXPECT_LT(step, 1.0 / 1500.0 / 30.0);
  EXPECT_GT(step, 1.0 / 1500.0 / 100.0);
}

// A day's cycle in seconds, with a time constant of an hour.
TEST(OwnStep, IsLongForASlowModel) {
  const System system = {
      "own_daily", {{"T", "(10*sin(phase) - T)/tau"}}, {0.0}, "tau", 3600.0, 7200.0, "86400"};
  const double step = step_of(system);
  EXPECT_GT(step, 200.0);
  EXPECT_LT(step, 3600.0 * 0.3);
}

// A narrow pulse anywhere in the period: some steps must fall within it.
TEST(OwnStep, SeesPulses) {
  for (const double width : {0.001, 0.003, 0.03}) {
    for (const double at : {0.5, 2.0, 4.7, 5.9, 6.2}) {
      const System system = {
          "own_pulse",
          {{"x", "v"}, {"v", fmt::format("exp(-((phase - {})/{})^2) - 0.3*v - k*x", at, width)}},
          {0.0, 0.0},
          "k",
          0.9,
          1.1,
          "2*pi"};
      EXPECT_LT(step_of(system), width) << at;
      EXPECT_GT(step_of(system), 0.01 * width) << at;
    }
  }
}

TEST(OwnStep, SaysThatTheStartIsNowhere) {
  const Study study = study_of({"own_radius",
                                {{"x", "-k*x/sqrt(x^2 + y^2)"}, {"y", "-y/sqrt(x^2 + y^2)"}},
                                {0.0, 0.0},
                                "k",
                                1.0,
                                2.0,
                                "1"});
  EXPECT_THAT(study.step_reason, HasSubstr("the equations are not finite at the start"));
}

// What a result or a journal keeps is the study's text.
TEST(OwnStep, IsTheSameWhenTheStudyIsReadAgain) {
  const Study study = study_of(kLorenz);
  const Study again = read_study(study.toml, "again");
  EXPECT_EQ(again.integrate.max_step, study.integrate.max_step);
  EXPECT_THAT(resolved_settings(study),
              HasSubstr(fmt::format("max_step = {}\n", study.integrate.max_step)));
  EXPECT_FALSE(study.step_reason.empty());
}

// At rest no error holds a step back: the rate of what would move does.
TEST(OwnStep, EndsWhereTheMotionRests) {
  System resting = kLorenz;
  resting.start = {0.0, 0.0, 0.0};
  EXPECT_GT(step_of(resting), 0.005);
  EXPECT_LT(step_of(resting), 0.03);
}

TEST(OwnStep, YieldsToWhatTheStudyGives) {
  const Study study = study_of(kLorenz);
  const Study given = read_study(study.toml, "again", {"integrate.max_step=0.02"});
  EXPECT_EQ(given.integrate.max_step, 0.02);
  EXPECT_TRUE(given.step_reason.empty());
}

}  // namespace
}  // namespace gearsweep::testing
