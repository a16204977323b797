// Maps do not depend on whether states that drive nothing are integrated.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;

// A light damping of one bearing across the line of action, so that its exponent is the largest of
// all where the mesh is periodic.
const std::string kGears =
    "[model]\npreset = 'coarse'\n[parameters]\nc1 = 0.2\n"
    "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.5\ncount = 8\n"
    "[[axes]]\nname = 'b'\nfrom = 0.4\nto = 1.2\ncount = 6\n"
    "[integrate]\nsettle = 300\nrecord = 128\nmax_step = 0.1\n";
const std::string kStates = "integrate.states=";

// Only along the line of action, where the shafts are alike.
TEST(PassiveStates, TheOtherStatesHaveTheSameBitsWithoutThem) {
  const std::string study = kGears +
                            "stop = 'never'\ncontract = false\n[observe]\n"
                            "quantities = ['x1_rms', 'dmf_max', 'contact_gap', 'x3_max']\n";
  const SweepResult driving = run(study, {kStates + "driving"});
  const SweepResult all = run(study, {kStates + "all"});
  EXPECT_THAT(driving.integrated, ElementsAre("x1", "x3", "v1", "v3"));
  EXPECT_EQ(all.integrated, all.study.model->state_names());
  for (const char* name : {"x1_rms", "dmf_max", "contact_gap", "x3_max"}) {
    EXPECT_EQ(map_of(driving, name), map_of(all, name)) << name;
  }
}

// y drives v where neither p nor q is 0: at one point of this list, at which neither is largest.
TEST(PassiveStates, AStateThatDrivesAtOnePointOfAListIsKept) {
  const std::string study =
      "[model]\ntext = '''\n[model]\nname = \"coupled\"\n[states]\nx = { start = \"b + F\" }\n"
      "v = {}\ny = {}\n[parameters]\nomega = { value = 0.8, min = 1e-4, max = 100 }\n"
      "b = { value = 1.0, min = 0 }\nF = 0.1\ne = 0.2\np = 0.0\nq = 0.0\n[equations]\nx = \"v\"\n"
      "v = \"F + e*cos(phase) - 0.1*v - backlash(x, b) + p*q*y\"\ny = \"cos(phase) - 0.5*y\"\n"
      "[forcing]\nperiod = \"2*pi/omega\"\n'''\n"
      "[points]\nnames = ['p', 'q']\nnumbers = '''\n1 0\n0 1\n0 0\n0 0\n0 0\n0 0\n0.5 0.5\n'''\n"
      "[integrate]\nsettle = 40\nrecord = 10\nstop = 'never'\n[observe]\nquantities = ['x_rms']\n";
  const SweepResult driving = run(study);
  const SweepResult all = run(study, {kStates + "all"});
  EXPECT_THAT(driving.integrated, ElementsAre("x", "v", "y"));
  EXPECT_EQ(map_of(driving, "x_rms"), map_of(all, "x_rms"));
}

// A model that is none of ours: w follows the others and drives nothing.
TEST(PassiveStates, AStateThatDrivesNothingChangesNoBit) {
  const std::string study =
      "[model]\ntext = '''\n[model]\nname = \"spring\"\n[states]\nx = { start = \"0.1\" }\nv = {}\n"
      "w = {}\n[parameters]\nomega = { value = 1.2, min = 1e-4, max = 100 }\nF = 0.3\n"
      "c = 0.4\n[equations]\nx = \"v\"\nv = \"F*cos(phase) - 0.2*v + x - x^3\"\n"
      "w = \"x*v + sin(phase) - c*w\"\n[forcing]\nperiod = \"2*pi/omega\"\n'''\n"
      "[[axes]]\nname = 'F'\nfrom = 0.1\nto = 0.5\ncount = 16\n[integrate]\nsettle = 60\n"
      "record = 20\nstop = 'never'\ncontract = false\n[observe]\n"
      "quantities = ['x_rms', 'x_max', 'v_min', 'poincare']\npoincare = ['x', 'v']\n";
  const SweepResult driving = run(study);
  const SweepResult all = run(study, {kStates + "all"});
  EXPECT_THAT(driving.integrated, ElementsAre("x", "v"));
  EXPECT_EQ(driving.samples, all.samples);
  for (const char* name : {"x_rms", "x_max", "v_min"}) {
    EXPECT_EQ(map_of(driving, name), map_of(all, name)) << name;
  }
}

TEST(PassiveStates, ThePeriodIsFoundWithoutThem) {
  const std::string study = kGears + "[observe]\nquantities = ['period', 'motion_class']\n";
  const SweepResult driving = run(study, {kStates + "driving"});
  const SweepResult all = run(study, {kStates + "all"});
  EXPECT_EQ(map_of(driving, "period"), map_of(all, "period"));
  EXPECT_EQ(map_of(driving, "motion_class"), map_of(all, "motion_class"));
}

TEST(PassiveStates, TheLargestExponentMayBeOneOfTheirs) {
  const std::string study = kGears + "[observe]\nquantities = ['lyapunov_max', 'period']\n";
  const SweepResult driving = run(study, {kStates + "driving"});
  const SweepResult all = run(study, {kStates + "all"});
  const double bearing = -0.3507525 * 0.2 * 0.04008;  // -m c zeta
  std::size_t periodic = 0;
  for (std::size_t i = 0; i < map_of(all, "period").size(); ++i) {
    const double exponent = map_of(driving, "lyapunov_max")[i];
    EXPECT_GE(exponent, bearing * (1.0 + 1e-12));
    if (map_of(all, "period")[i] < 1.0) continue;
    ++periodic;
    EXPECT_NEAR(exponent, map_of(all, "lyapunov_max")[i], 1e-6) << i;
  }
  EXPECT_GE(periodic, 10U);
}

}  // namespace
}  // namespace gearsweep::testing
