// What is averaged and counted where nothing drives the motion, and when a cycle ends early.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "study/refusal.hpp"
#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// r' = r (1 - r^2) and a turn at the rate w, in any units, about any centre: a circle in 2 pi/w,
// which a start at r0 nears by 1 - r = (1/r0^2 - 1)/2 exp(-2 t). The frequencies have no common
// period, so no record is a whole number of all cycles.
std::string circle(double size, double unit, double centre, const std::string& rest) {
  return fmt::format(R"toml([model]
text = """
[model]
name = "circle"
[states]
x = {{ start = "centre + 0.1*size" }}
y = {{}}
[parameters]
w = 1.0
size = {}
unit = {}
centre = {}
[constants]
a = "(x - centre)/size"
b = "y/size"
grow = "1 - a^2 - b^2"
[equations]
x = "(a*grow - w*b)*size/unit"
y = "(b*grow + w*a)*size/unit"
"""
[[axes]]
name = "w"
values = [0.7, 1.0, 1.3, 1.7, 2.3]
{})toml",
                     size, unit, centre, rest);
}

constexpr const char* kMeasured =
    "[observe]\nquantities = ['motion_class', 'x_mean', 'x_std', 'x_max', 'maxima_returns', "
    "'cycle_time']\n";

TEST(CycleAverages, KnowNothingOfWhereTheRecordEnds) {
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    for (const auto& [size, unit, centre] : {std::tuple(1.0, 1.0, 0.0), {1e-6, 1e3, 1e-5}}) {
      SCOPED_TRACE(size);
      const SweepResult result = run(
          circle(size, unit, centre,
                 fmt::format("[integrate]\nstop = 'never'\nengine = '{}'\n{}", engine, kMeasured)));
      for (std::size_t i = 0; i < 5; ++i) {
        const double turn = 2.0 * std::numbers::pi / result.study.axes[0].values[i] * unit;
        EXPECT_EQ(map_of(result, "motion_class")[i], MOTION_periodic);
        EXPECT_NEAR((map_of(result, "x_mean")[i] - centre) / size, 0.0, 1e-5);
        EXPECT_NEAR(map_of(result, "x_std")[i] / size, std::sqrt(0.5), 1e-6);
        EXPECT_NEAR(map_of(result, "cycle_time")[i] / turn, 1.0, 3e-6);
        EXPECT_NEAR(map_of(result, "maxima_returns")[i] * turn, 1.0, 1e-4);
      }
    }
  }
}

TEST(CycleAverages, AreThoseOfAShortRecordWhereTheCycleSettlesEarly) {
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const std::string integrate = fmt::format("[integrate]\nengine = '{}'\n", engine);
    const SweepResult early = run(circle(1.0, 1.0, 0.0, integrate + kMeasured));
    const SweepResult late = run(circle(1.0, 1.0, 0.0, integrate + "stop = 'never'\n" + kMeasured));
    // Returns are found as well as the steps let them: one of the five may go on.
    EXPECT_LT(2.0 * early.steps, late.steps);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(map_of(early, "motion_class")[i], MOTION_periodic);
      EXPECT_NEAR(map_of(early, "x_mean")[i], 0.0, 1e-4);
      EXPECT_NEAR(map_of(early, "x_max")[i], map_of(late, "x_max")[i], 1e-6);
      EXPECT_NEAR(map_of(early, "cycle_time")[i] / map_of(late, "cycle_time")[i], 1.0, 1e-7);
    }
  }
}

// What asks for exponents or samples has its whole record.
TEST(CycleAverages, AreThoseOfTheWholeRecordBesideExponents) {
  const std::string exponents = "[observe]\nquantities = ['motion_class', 'x_std', '{}']\n";
  for (const char* quantity : {"lyapunov_max", "poincare", "zero_one", "attractor"}) {
    const std::string observe = fmt::format(fmt::runtime(exponents), quantity);
    const SweepResult early = run(circle(1.0, 1.0, 0.0, observe));
    const SweepResult late = run(circle(1.0, 1.0, 0.0, "[integrate]\nstop = 'never'\n" + observe));
    EXPECT_EQ(early.steps, late.steps) << quantity;
    EXPECT_EQ(map_of(early, "x_std"), map_of(late, "x_std")) << quantity;
  }
}

// Recurrences within a millionth of the diameter begin where 50 exp(-2 t) is 2e-6; the reference
// that they begin at lies up to as many returns later as went before.
TEST(CycleAverages, TellWhenTheMotionHadSettled) {
  for (const char* engine : {"opencl", "reference"}) {
    const SweepResult result = run(circle(
        1.0, 1e-3, 0.0,
        fmt::format("[integrate]\nengine = '{}'\nsettle = 0\nwarm_up = 0\n[observe]\nquantities = "
                    "['settling_time', 'cycle_time', 'motion_class']\n",
                    engine)));
    for (std::size_t i = 0; i < 5; ++i) {
      const double cycle = map_of(result, "cycle_time")[i];
      EXPECT_GT(map_of(result, "settling_time")[i], 8e-3) << engine;
      EXPECT_LT(map_of(result, "settling_time")[i], 2.0 * (8.6e-3 + 2.0 * cycle)) << engine;
    }
  }
}

TEST(CycleAverages, GoByNoForcingThatIsNotThere) {
  const auto answer = [](const std::string& quantity) {
    return refusal(circle(1.0, 1.0, 0.0, "[observe]\nquantities = ['" + quantity + "']\n"));
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(answer("settled"), HasSubstr("has none: settling_time is the time until"));
  for (const char* quantity : {"lyapunov_max_per_period", "section_max", "x_order_amplitude"}) {
    EXPECT_THAT(answer(quantity), HasSubstr("goes by the periods of a forcing")) << quantity;
  }
}

}  // namespace
}  // namespace gearsweep::testing
