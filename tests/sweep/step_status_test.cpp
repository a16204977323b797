// What a sweep says of points whose motion has outgrown the step that was found for it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// Two wells, `size` apart, whose motions lose energy where zeta is above 0. Below, they gain it at
// any size, and the larger they are, the faster they go.
std::string wells(double size, const std::string& zetas) {
  return fmt::format(
      "[model]\ntext = '''\n[model]\nname = \"wells\"\n[states]\nx = {{ start = \"{0}/2\" }}\n"
      "v = {{}}\n[parameters]\nomega = 1.0\nzeta = {{ value = 0.2, min = -1 }}\n[equations]\n"
      "x = \"v\"\nv = \"x - 4*x^3/{0}^2 - 2*zeta*v + {0}/20*cos(phase)\"\n[forcing]\n"
      "period = \"2*pi/omega\"\n'''\n[[axes]]\nname = 'zeta'\nvalues = [{1}]\n[observe]\n"
      "quantities = ['x_max']\n",
      size, zetas);
}

TEST(StepStatus, TellsOfAMotionThatTheMethodAloneHolds) {
  const SweepResult result = run(wells(4e-6, "-0.2, -0.05, 0.05, 0.2"));
  EXPECT_EQ(result.status, (std::vector<std::uint8_t>{STATUS_step_too_long, STATUS_step_too_long,
                                                      STATUS_ok, STATUS_ok}));
  EXPECT_TRUE(std::isnan(map_of(result, "x_max")[0]));
  EXPECT_FALSE(std::isnan(map_of(result, "x_max")[2]));
}

TEST(StepStatus, DoesNotDependOnTheUnit) {
  EXPECT_EQ(run(wells(1.0, "-0.2, -0.05, 0.05, 0.2")).status,
            run(wells(3e7, "-0.2, -0.05, 0.05, 0.2")).status);
}

// A resonance that builds up over a thousand periods goes far beyond its beginning, and is no
// faster there; the amplitude is F/(2 zeta).
TEST(StepStatus, AMotionThatGrowsIsNotRefused) {
  const SweepResult result =
      run("[model]\ntext = '''\n[model]\nname = \"swing\"\n[states]\nx = {}\nv = {}\n"
          "[parameters]\nzeta = 1e-3\n[equations]\nx = \"v\"\nv = \"-x - 2*zeta*v + cos(phase)\"\n"
          "[forcing]\nperiod = \"2*pi\"\n'''\n[[axes]]\nname = 'zeta'\nvalues = [1e-3]\n"
          "[integrate]\nsettle = 3000\nstop = 'never'\n[observe]\nquantities = ['x_max']\n");
  EXPECT_EQ(result.status.front(), STATUS_ok);
  EXPECT_NEAR(map_of(result, "x_max")[0], 500.0, 0.1);
}

// Nor is a resonance between the places that the step was found at: the spring hardens, so that the
// motion is some times as large there, and faster.
TEST(StepStatus, AResonanceBetweenTheProbesIsNotRefused) {
  const SweepResult result =
      run("[model]\ntext = '''\n[model]\nname = \"hardening\"\n[states]\nx = {}\nv = {}\n"
          "[parameters]\nomega = 1.0\n[equations]\nx = \"v\"\n"
          "v = \"-x - 0.05*x^3 - 0.1*v + cos(phase)\"\n[forcing]\nperiod = \"2*pi/omega\"\n'''\n"
          "[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 3.5\ncount = 48\n[observe]\n"
          "quantities = ['x_max']\n");
  for (const std::uint8_t status : result.status) EXPECT_EQ(status, STATUS_ok);
}

}  // namespace
}  // namespace gearsweep::testing
