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
