// Impacts that follow each other ever faster end in contact, however little each one takes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// A ball that falls from the height 1 with the acceleration 1 and bounces. Its flights last
// 2 sqrt(2) r^n, so all of them (1 + r)/(1 - r) times the first fall; the ball is at the mean of
// 2/3 of the height r^(2 n) of each.
TEST(Chatter, EndsAfterTheSumOfAllFlights) {
  for (const char* engine : {"opencl", "reference"}) {
    const SweepResult result = run(fmt::format(R"toml([model]
text = """
[model]
name = "ball"
[states]
y = {{ start = "1" }}
v = {{}}
[parameters]
r = {{ value = 0.5, min = 0, max = 1 }}
[equations]
y = "v"
v = "-1"
[forcing]
period = "1"
[surfaces.ground]
when = "-y"
reset = {{ v = "-r*v" }}
"""
[[axes]]
name = "r"
values = [0.5, 0.9, 0.97, 0.99, 0.992]
[integrate]
settle = 0
record = 400
extend = 1
stop = "never"
warm_up = 0
max_step = 0.05
engine = "{}"
[observe]
quantities = ["sticking_share", "sticking_stops", "y_mean", "y_min"]
)toml",
                                               engine));
    for (std::size_t i = 0; i < 5; ++i) {
      const double r = result.study.axes[0].values[i];
      SCOPED_TRACE(fmt::format("{} {}", engine, r));
      const double fall = std::sqrt(2.0);
      const double end = fall * (1.0 + r) / (1.0 - r);
      const double cubes = r * r * r / (1.0 - r * r * r);
      const double sum = 2.0 / 3.0 * fall * (1.0 + 2.0 * cubes);
      EXPECT_EQ(result.status[i], STATUS_ok);
      // What is left out takes less than a fiftieth of a step over 1 - r.
      EXPECT_NEAR(400.0 * (1.0 - map_of(result, "sticking_share")[i]), end, 1e-3 / (1.0 - r));
      EXPECT_NEAR(400.0 * map_of(result, "sticking_stops")[i], 1.0, 1e-12);
      EXPECT_NEAR(400.0 * map_of(result, "y_mean")[i], sum, 1e-4);
      EXPECT_GE(map_of(result, "y_min")[i], -1e-6);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
