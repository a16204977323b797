// Several surfaces where the state is reset at one moment: opposite ones at one place, and impacts
// of bodies that rest against each other.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

SweepResult run_with(const char* engine, const std::string& model, const std::string& study) {
  return run(fmt::format("[model]\ntext = '''\n{}'''\n{}", model, study),
             {fmt::format("integrate.engine='{}'", engine)});
}

// As a block that rocks from one edge to the other, it loses speed where it goes through 0, either
// way, and goes on. Against SciPy's DOP853 with located events.
TEST(ResetsAtOnce, OppositeSurfacesAtOnePlaceResetOnceEach) {
  constexpr const char* kThrough = R"toml([model]
name = "through"
[states]
th = { start = "0.1" }
w = {}
[parameters]
r = 0.85
[equations]
th = "w"
w = "-th + 0.2*cos(phase)"
[forcing]
period = "pi"
[surfaces.up]
when = "th"
reset = { w = "r*w" }
[surfaces.down]
when = "-th"
reset = { w = "r*w" }
)toml";
  constexpr const char* kStudy = R"toml([[axes]]
name = "r"
values = [0.6, 0.85]
[integrate]
settle = 200
record = 50
stop = "never"
[observe]
quantities = ["th_max", "th_min", "up_impacts", "down_impacts", "period", "lyapunov_max"]
)toml";
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run_with(engine, kThrough, kStudy);
    EXPECT_NEAR(map_of(result, "th_max")[0], 0.060256625, 1e-7);
    EXPECT_NEAR(map_of(result, "th_min")[0], -0.060256625, 1e-7);
    EXPECT_NEAR(map_of(result, "th_max")[1], 0.065881104, 1e-7);
    EXPECT_NEAR(map_of(result, "th_min")[1], -0.065881104, 1e-7);
    const double r[] = {0.6, 0.85};
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(map_of(result, "up_impacts")[i], 1.0);
      EXPECT_EQ(map_of(result, "down_impacts")[i], 1.0);
      EXPECT_EQ(map_of(result, "period")[i], 1.0);
      // Each of the two crossings in pi shrinks areas by r^2: the multipliers are a complex pair.
      EXPECT_NEAR(map_of(result, "lyapunov_max")[i], 2.0 * std::log(r[i]) / std::numbers::pi, 2e-3);
    }
  }
}

// Body 1 drags body 2 by a hook, hits a wall, and is thrown back: body 2 flies on. With the centre
// of mass the wall is hit at sqrt(3.2 0.98125), at the speed 1.1075028.
TEST(ResetsAtOnce, AnImpactThrowsABodyOffWhatItRestsAgainst) {
  constexpr const char* kHook = R"toml([model]
name = "hook"
[states]
x1 = { start = "1" }
v1 = {}
x2 = { start = "1.15" }
v2 = {}
[parameters]
omega = 1.0
m = 0.6
b = 0.2
[constants]
ds = "v2 - v1"
[equations]
x1 = "v1"
v1 = "-1"
x2 = "v2"
v2 = "0"
[forcing]
period = "2/omega"
[surfaces.wall]
when = "-x1"
reset = { v1 = "-0.6*v1" }
[surfaces.hook]
when = "x2 - x1 - b"
reset = { v1 = "v1 + 1.5*ds*m/(1 + m)", v2 = "v2 - 1.5*ds/(1 + m)" }
)toml";
  constexpr const char* kStudy = R"toml([[axes]]
name = "omega"
values = [1.0]
[integrate]
settle = 0
record = 1
warm_up = 0
stop = "never"
steps_per_period = 100
[observe]
quantities = ["x1_min", "v2_min", "wall_impacts", "wall_impact_speed", "poincare"]
poincare = ["x1", "v1", "x2", "v2"]
)toml";
  const double met = std::sqrt(3.2 * 0.98125), speed = met / 1.6, later = 2.0 - met;
  const double place = -0.5 * later * later + 0.6 * speed * later;
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run_with(engine, kHook, kStudy);
    EXPECT_GE(map_of(result, "x1_min")[0], -1e-12);
    EXPECT_NEAR(map_of(result, "v2_min")[0], -speed, 1e-6);
    EXPECT_EQ(map_of(result, "wall_impacts")[0], 1.0);
    EXPECT_NEAR(map_of(result, "wall_impact_speed")[0], speed, 1e-6);
    EXPECT_NEAR(samples_of(result, 0, 0)[0], place, 1e-6);
    EXPECT_NEAR(samples_of(result, 0, 2)[0], 0.2 - speed * later, 1e-6);
  }
}

// A driving shaft that swings, and two loose gears, each between two flanks: however they come to
// rest against each other, no tooth goes through another.
TEST(ResetsAtOnce, NoToothOfAGearTrainGoesThroughAnother) {
  constexpr const char* kTrain = R"toml([model]
name = "train"
[states]
x1 = {}
v1 = {}
x2 = { start = "0.01" }
v2 = {}
[parameters]
omega = { value = 1.0, min = 0.1 }
m = 0.6
[constants]
u = "x1 - sin(phase)"
du = "v1 - omega*cos(phase)"
s = "x2 - x1"
ds = "v2 - v1"
[equations]
x1 = "v1"
v1 = "-0.15 - 0.05*v1"
x2 = "v2"
v2 = "-0.1 - 0.02*v2"
[forcing]
period = "2*pi/omega"
[surfaces.drive]
when = "-u"
reset = { v1 = "v1 - 1.6*du" }
[surfaces.back]
when = "u - 0.3"
reset = { v1 = "v1 - 1.6*du" }
[surfaces.next_drive]
when = "-s"
reset = { v1 = "v1 + 1.5*ds*m/(1 + m)", v2 = "v2 - 1.5*ds/(1 + m)" }
[surfaces.next_back]
when = "s - 0.2"
reset = { v1 = "v1 + 1.5*ds*m/(1 + m)", v2 = "v2 - 1.5*ds/(1 + m)" }
[signals]
gap = "u"
next_gap = "s"
)toml";
  constexpr const char* kStudy = R"toml([[axes]]
name = "omega"
values = [0.25, 0.45, 0.6, 0.8, 1.0, 1.3, 1.8, 2.5]
[integrate]
settle = 0
record = 12
steps_per_period = 128
stop = "never"
[observe]
quantities = ["gap_min", "gap_max", "next_gap_min", "next_gap_max"]
)toml";
  const SweepResult result = run_with("opencl", kTrain, kStudy);
  constexpr double kCubics = 1e-3;  // what cubics between moments of a step make of an extreme
  std::size_t told = 0;             // that more impacts fell into a step than are followed
  for (std::size_t i = 0; i < 8; ++i) {
    if (std::isnan(map_of(result, "gap_min")[i])) {
      ++told;
      continue;
    }
    EXPECT_GT(map_of(result, "gap_min")[i], -kCubics) << i;
    EXPECT_LT(map_of(result, "gap_max")[i], 0.3 + kCubics) << i;
    EXPECT_GT(map_of(result, "next_gap_min")[i], -kCubics) << i;
    EXPECT_LT(map_of(result, "next_gap_max")[i], 0.2 + kCubics) << i;
  }
  EXPECT_LE(told, 1U);
}

// Three bodies over a table that may shake.
constexpr const char* kStack = R"toml([model]
name = "stack"
[states]
x1 = { start = "0.5" }
v1 = {}
x2 = { start = "0.8" }
v2 = {}
x3 = { start = "1.5" }
v3 = {}
[parameters]
T = { value = 2.3, min = 0.1 }
m2 = 0.6
m3 = 1.7
A = 0.0
[constants]
ground_place = "A*sin(phase)"
ground_speed = "A*2*pi/T*cos(phase)"
[equations]
x1 = "v1"
v1 = "-1"
x2 = "v2"
v2 = "-1"
x3 = "v3"
v3 = "-1"
[forcing]
period = "T"
[surfaces.ground]
when = "ground_place - x1"
reset = { v1 = "ground_speed - 0.4*(v1 - ground_speed)" }
[surfaces.one]
when = "x1 - x2"
reset = { v1 = "v1 - 1.3*(v1 - v2)*m2/(1 + m2)", v2 = "v2 + 1.3*(v1 - v2)/(1 + m2)" }
[surfaces.two]
when = "x2 - x3"
reset = { v2 = "v2 - 1.3*(v2 - v3)*m3/(m2 + m3)", v3 = "v3 + 1.3*(v2 - v3)*m2/(m2 + m3)" }
[signals]
least = "min(min(x1 - ground_place, x2 - x1), x3 - x2)"
)toml";

// They fall on the table, still or shaken. On a still one they end on each other at rest; no
// body ever goes through another one. Where impacts come by the hundred, between a table and a
// heavy body, the point says so.
TEST(ResetsAtOnce, BodiesInAStackStayInTheirOrder) {
  constexpr const char* kStudy = R"toml([[axes]]
name = "m3"
from = 0.1
to = 4.0
count = 6
[[axes]]
name = "A"
from = 0.0
to = 0.5
count = 6
[integrate]
settle = 40
record = 20
stop = "never"
max_step = 0.05
[observe]
quantities = ["least_min", "x3_max", "sticking_share"]
)toml";
  const SweepResult result = run_with("opencl", kStack, kStudy);
  std::size_t told = 0;
  for (std::size_t i = 0; i < 36; ++i) {
    if (std::isnan(map_of(result, "x3_max")[i])) {
      ++told;
      continue;
    }
    // Cubics between the moments of a step make so much of an extreme.
    EXPECT_GT(map_of(result, "least_min")[i], -1e-3) << i;
    if (i >= 6) continue;  // the first six are on a still table
    EXPECT_NEAR(map_of(result, "x3_max")[i], 0.0, 1e-9) << i;
    EXPECT_NEAR(map_of(result, "sticking_share")[i], 1.0, 1e-9) << i;
  }
  EXPECT_LE(told, 4U);
}

// Nothing is left of a neighbour: all states are those of the table.
TEST(ResetsAtOnce, WhatRestsInAStackHasLostAllExponents) {
  constexpr const char* kStudy = R"toml([[axes]]
name = "A"
values = [0.02, 0.05]
[integrate]
settle = 20
record = 4
stop = "never"
max_step = 0.05
[observe]
quantities = ["lyapunov_spectrum", "sticking_share"]
)toml";
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run_with(engine, kStack, kStudy);
    for (const double share : map_of(result, "sticking_share")) EXPECT_NEAR(share, 1.0, 1e-9);
    for (const double exponent : map_of(result, "lyapunov_spectrum")) {
      EXPECT_EQ(exponent, -std::numeric_limits<double>::infinity());
    }
  }
}

// Two masses on springs that meet without rebound and go on together until what holds them together
// is gone. Against SciPy's DOP853 with located events, the two as one while they touch. Behind
// such a parting the level leaves 0 with the third power of time, and its cubic is rounding.
TEST(ResetsAtOnce, BodiesThatHaveRestedAgainstEachOtherPart) {
  constexpr const char* kPair = R"toml([model]
name = "pair"
[states]
x = {}
y = { start = "0.3" }
v = {}
w = {}
[parameters]
omega = 1.0
F = 0.6
m = 0.4
[equations]
x = "v"
y = "w"
v = "F*cos(phase) - 0.05*v - x"
w = "(-2*(y - 0.3) - 0.05*w)/m"
[forcing]
period = "2*pi/omega"
[surfaces.meet]
when = "x - y"
reset = { v = "(v + m*w)/(1 + m)", w = "(v + m*w)/(1 + m)" }
)toml";
  constexpr const char* kStudy = R"toml([[axes]]
name = "omega"
values = [0.5, 0.9, 1.3]
[[axes]]
name = "F"
values = [0.5, 0.8]
[integrate]
settle = 60
record = 8
stop = "never"
[observe]
quantities = ["x_mean", "sticking_share", "meet_impacts"]
)toml";
  struct Known {
    std::size_t point;
    double mean, share, impacts;
  };
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run_with(engine, kPair, kStudy);
    EXPECT_THAT(result.status, ::testing::Each(STATUS_ok));
    for (const Known& known : {Known{3, -0.12191922738592, 0.408820290128, 2.0},
                               Known{4, -0.30453005967508, 0.291873680312, 1.0},
                               Known{2, -0.12798015242004, 0.118146203874, 2.0}}) {
      EXPECT_NEAR(map_of(result, "x_mean")[known.point], known.mean, 1e-6);
      EXPECT_NEAR(map_of(result, "sticking_share")[known.point], known.share, 2e-6);
      EXPECT_EQ(map_of(result, "meet_impacts")[known.point], known.impacts);
    }
  }
}

// A motion that is none before its record begins has no exponents, and is no crash.
TEST(ResetsAtOnce, MotionsThatDivergeBeforeTheRecordHaveNoExponents) {
  constexpr const char* kStudy = R"toml([[axes]]
name = "A"
values = [1e9]
[integrate]
settle = 2
record = 2
stop = "never"
diverged_above = 1e6
[observe]
quantities = ["lyapunov_spectrum", "kaplan_yorke", "sticking_share", "x1_max"]
)toml";
  const SweepResult result = run_with("reference", kStack, kStudy);
  for (const double exponent : map_of(result, "lyapunov_spectrum")) {
    EXPECT_TRUE(std::isnan(exponent));
  }
}

}  // namespace
}  // namespace gearsweep::testing
