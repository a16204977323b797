// What is narrower than a step: a model without max_step finds the steps that see it, in the
// equations and not by luck.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// Three lags in a loop with a switch of this steepness, in any unit of time.
std::string switched(double steepness, double unit) {
  return fmt::format(R"toml([model]
text = """
[model]
name = "switched"
[states]
x = {{ start = "1" }}
y = {{}}
z = {{}}
[parameters]
steepness = {0}
unit = {1}
[equations]
x = "y/unit"
y = "z/unit"
z = "(-2*z - 2*y - tanh(steepness*x))/unit"
"""
[[axes]]
name = "steepness"
values = [{0}]
[observe]
quantities = ["motion_class", "cycle_time", "x_max", "x_rms"]
)toml",
                     steepness, unit);
}

// The cycle of an ideal switch, by Runge-Kutta steps of 1e-5 of another program; what is left of
// the steepness falls with its square.
TEST(Steep, SwitchesAreSeenHoweverNarrowTheyAre) {
  for (const double steepness : {1000.0, 3000.0, 10000.0}) {
    for (const double unit : {1.0, 1e-6}) {
      SCOPED_TRACE(fmt::format("{} {}", steepness, unit));
      const SweepResult result = run(switched(steepness, unit));
      EXPECT_EQ(map_of(result, "motion_class")[0], MOTION_periodic);
      EXPECT_NEAR(map_of(result, "cycle_time")[0] / unit, 4.502038, 2e-5);
      EXPECT_NEAR(map_of(result, "x_max")[0], 0.324747, 1e-5);
      EXPECT_NEAR(map_of(result, "x_rms")[0], 0.231109, 3e-4);  // of ten cycles
    }
  }
}

// A push of width w on the way up that adds 1/2 to the speed: none of the moments of a long step
// need lie in it.
TEST(Steep, PulsesInAStateAreSeen) {
  const SweepResult result = run(R"toml([model]
text = """
[model]
name = "pushed"
[states]
x = { start = "1" }
v = {}
[parameters]
w = 1e-3
[constants]
push = "0.5*exp(-(x/w)^2)/(w*sqrt(pi))"
[equations]
x = "v"
v = "-x - 0.1*v + if(v > 0, push*v, 0) - 0.05*v^3"
"""
[[axes]]
name = "w"
values = [1e-4, 1e-3, 1e-2]
[observe]
quantities = ["motion_class", "cycle_time", "x_max"]
)toml");
  const SweepResult instant = run(R"toml([model]
text = """
[model]
name = "pushed"
[states]
x = { start = "1" }
v = {}
[parameters]
push = 0.5
[equations]
x = "v"
v = "-x - 0.1*v - 0.05*v^3"
[surfaces.middle]
when = "x"
reset = { v = "v + push" }
"""
[[axes]]
name = "push"
values = [0.5]
[observe]
quantities = ["x_max", "top_cycle_time"]
[sections.top]
when = "v"
direction = "down"
)toml");
  for (std::size_t i = 0; i < 3; ++i) {
    const double width = result.study.axes[0].values[i];
    EXPECT_EQ(map_of(result, "motion_class")[i], MOTION_periodic);
    EXPECT_NEAR(map_of(result, "x_max")[i], map_of(instant, "x_max")[0], 0.05 * width + 1e-5);
    EXPECT_NEAR(map_of(result, "cycle_time")[i], map_of(instant, "top_cycle_time")[0],
                0.2 * width + 1e-5);
  }
}

}  // namespace
}  // namespace gearsweep::testing
