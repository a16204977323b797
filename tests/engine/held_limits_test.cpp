// An integrator that is held at its limits: both sides of a surface have the same field at times,
// or none, and nothing but rounding says on which side a motion is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// x' = y, which is cos t on a circle, held at 1/2 while y > 0 and at -1/2 while y < 0.
std::string held(const std::string& rate, double size, double unit, const std::string& integrate) {
  return fmt::format(R"toml([model]
text = """
[model]
name = "held"
[states]
y = {{ start = "1" }}
z = {{}}
x = {{}}
[parameters]
w = 1.0
size = {}
unit = {}
[constants]
a = "x/size"
grow = "1 - y^2 - z^2"
[equations]
y = "(z + y*grow)/unit"
z = "(-w*y + z*grow)/unit"
x = "({})*size/unit"
"""
[[axes]]
name = "w"
values = [1.0]
[integrate]
{}
[observe]
quantities = ["x_max", "x_min", "x_rms", "motion_class", "cycle_time"]
)toml",
                     size, unit, rate, integrate);
}

const std::string kForms[] = {
    "if(a >= 0.5 and y > 0, 0, if(a <= -0.5 and y < 0, 0, y))",
    "if(a > 0.5, min(y, 0), if(a < -0.5, max(y, 0), y))",
    "if(a > 0.5, if(y > 0, 0, y), if(a < -0.5, if(y < 0, 0, y), y))",
    // These push back, so that the motion slides.
    "y - 2*y*step(a - 0.5)*step(y) - 2*y*step(-a - 0.5)*step(-y)",
    "y - 0*a - if(a > 0.5, 3*max(y, 0), 0) - if(a < -0.5, 3*min(y, 0), 0)",
};

void expect_kept(const std::string& form, const std::string& engine, double size, double unit,
                 double step) {
  SCOPED_TRACE(fmt::format("{} {} {}", form, engine, size));
  const double pi = std::numbers::pi;
  const SweepResult result =
      run(held(form, size, unit, fmt::format("engine = '{}'\nmax_step = {}", engine, step)));
  EXPECT_EQ(result.status[0], STATUS_ok);
  // The middle of a step in which y passes 0 overshoots by up to h^2/60 of the limit: 4e-5.
  EXPECT_NEAR(map_of(result, "x_max")[0] / size, 0.5, 1e-3);
  EXPECT_NEAR(map_of(result, "x_min")[0] / size, -0.5, 1e-3);
  EXPECT_NEAR(map_of(result, "x_rms")[0] / size, std::sqrt((pi - 2.0) / (2.0 * pi)), 1e-3);
  EXPECT_EQ(map_of(result, "motion_class")[0], MOTION_periodic);
  EXPECT_NEAR(map_of(result, "cycle_time")[0] / unit, 2.0 * pi, 1e-3);
}

// One that stops at a limit, and one that is pushed back to it.
TEST(HeldLimits, AreKept) {
  expect_kept(kForms[0], "opencl", 1.0, 1.0, 0.05);
  expect_kept(kForms[3], "opencl", 1.0, 1.0, 0.05);
}

TEST(HeldLimits, AreKeptHoweverTheyAreWritten) {
  for (const std::string& form : kForms) {
    for (const char* engine : {"opencl", "reference"}) {
      for (const auto& [size, unit, step] :
           {std::tuple(1.0, 1.0, 0.05), {1e6, 1e-3, 4e-5}, {1e-9, 1e3, 10.0}}) {
        expect_kept(form, engine, size, unit, step);
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
