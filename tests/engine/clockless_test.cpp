// Models without forcing: time has no phase, and a motion is judged by its returns to a section.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "plan/plan.hpp"
#include "study/refusal.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// x'' = mu (1 - x^2) x' - x, with lengths in `size` and times in `unit`.
std::string van_der_pol(double size, double unit, const std::string& rest) {
  return fmt::format(R"toml([model]
text = """
[model]
name = "free"
[states]
x = {{ start = "2*size" }}
v = {{}}
[parameters]
mu = 1.0
size = {}
unit = {}
[equations]
x = "v"
v = "mu*(1 - (x/size)^2)*v/unit - x/unit^2"
"""
[[axes]]
name = "mu"
values = [0.5, 1.0, 10.0]
[observe]
quantities = ["motion_class", "period", "cycle_time", "maxima_return_time", "poincare", "x_max"]
{})toml",
                     size, unit, rest);
}

// The period at mu = 1 and 10 by DOP853 with located maxima, tolerance 1e-13.
TEST(Clockless, CyclesHaveTheirPeriodInAnyUnits) {
  for (const auto& [size, unit] : {std::pair(1.0, 1.0), {1e-6, 1e3}, {1000.0, 1e-9}}) {
    SCOPED_TRACE(size);
    const SweepResult result = run(van_der_pol(size, unit, ""));
    EXPECT_THAT(map_of(result, "motion_class"), ::testing::Each(MOTION_periodic));
    EXPECT_THAT(map_of(result, "period"), ::testing::Each(1.0));
    EXPECT_NEAR(map_of(result, "cycle_time")[1] / unit, 6.663286859, 1e-6);
    EXPECT_NEAR(map_of(result, "cycle_time")[2] / unit, 19.07836957, 3e-5);
    for (std::size_t i = 0; i < 3; ++i) {
      // Samples are those of the section.
      EXPECT_NEAR(samples_of(result, i, 0)[0] / map_of(result, "x_max")[i], 1.0, 1e-6);
    }
  }
}

TEST(Clockless, TellsRestCycleAndChaosByTheExponentsThatSuchMotionsHave) {
  const auto classes = [](const std::string& model, const std::string& axis) {
    return map_of(run(fmt::format(
                      "[model]\nname = '{}'\n[[axes]]\n{}\n[integrate]\nsettle = 2000\n"
                      "record = 1000\nmax_step = 0.002\n[observe]\nquantities = ['motion_class']\n",
                      model, axis)),
                  "motion_class");
  };
  EXPECT_THAT(classes("brusselator", "name = 'b'\nvalues = [1.5, 1.9, 2.1, 3.0]"),
              ::testing::ElementsAre(MOTION_equilibrium, MOTION_equilibrium, MOTION_periodic,
                                     MOTION_periodic));
  EXPECT_THAT(
      classes("rossler", "name = 'c'\nvalues = [2.5, 3.5, 4.0, 5.7]"),
      ::testing::ElementsAre(MOTION_periodic, MOTION_periodic, MOTION_periodic, MOTION_chaotic));
  EXPECT_THAT(classes("lorenz", "name = 'rho'\nvalues = [10.0, 28.0, 160.0]"),
              ::testing::ElementsAre(MOTION_equilibrium, MOTION_chaotic, MOTION_periodic));
}

// Two oscillators of van der Pol without a coupling: frequencies 1 and sqrt(2).
constexpr const char* kTorus = R"toml([model]
text = """
[model]
name = "torus"
[states]
x = { start = "1" }
v = {}
y = { start = "0.5" }
w = {}
[parameters]
mu = 0.3
[equations]
x = "v"
v = "mu*(1 - x^2)*v - x"
y = "w"
w = "mu*(1 - y^2)*w - 2*y"
"""
[[axes]]
name = "mu"
values = [0.2, 0.3]
[integrate]
settle = 500
record = 1000
[observe]
quantities = ["motion_class", "maxima_period"]
)toml";

TEST(Clockless, TellsATorusFromACycleThatHasNotSettled) {
  EXPECT_THAT(map_of(run(kTorus), "motion_class"), ::testing::Each(MOTION_quasi_periodic));
  const SweepResult unsettled =
      run(van_der_pol(1.0, 1.0, "[integrate]\nsettle = 0\nrecord = 8\nextend = 1\n"));
  for (const double kind : map_of(unsettled, "motion_class")) {
    EXPECT_THAT(kind, ::testing::AnyOf(MOTION_undecided, MOTION_periodic));
  }
}

// From far away the steps are so short that a return takes hundreds of thousands of them.
TEST(Clockless, AStiffStartIsNoReasonToRefuse) {
  const std::string study =
      van_der_pol(1.0, 1.0, "[initial]\npolicy = 'fixed'\nstate = { x = 100.0 }\n");
  const Plan plan(read_study(study, "test.toml", {"integrate.settle=0"}), 16);
  EXPECT_LE(plan.steps_of(0), 4096U);
}

TEST(Clockless, AreJudgedAlikeByBothEngines) {
  for (const std::string given :
       {"name = 'brusselator'\n[parameters]\nb = 2.6",
        "name = 'brusselator'\n[parameters]\nb = 1.6", "name = 'rossler'\n[parameters]\nc = 3.4"}) {
    SCOPED_TRACE(given);
    const std::string study = fmt::format(
        "[model]\n{}\n[[axes]]\nname = 'x'\nfrom = 0.4\nto = 1.1\ncount = 3\n[integrate]\n"
        "settle = 300\nrecord = 300\nextend = 1\n[observe]\n"
        "quantities = ['motion_class', 'period', 'cycle_time']\n",
        given);
    const SweepResult kernel = run(study), reference = run(study, {"integrate.engine=reference"});
    EXPECT_EQ(map_of(kernel, "motion_class"), map_of(reference, "motion_class"));
    EXPECT_EQ(map_of(kernel, "period"), map_of(reference, "period"));
  }
}

TEST(Clockless, SayWhatIsWrongWithThem) {
  const auto refused = [](const std::string& equation) {
    return refusal(
        "[model]\ntext = '''\n[model]\nname = \"a\"\n[states]\nx = {}\nv = {}\n"
        "[parameters]\nk = 1.0\n[equations]\nx = \"v\"\nv = \"" +
        equation + "\"\n'''\n[[axes]]\nname = 'k'\nfrom = 1\nto = 2\ncount = 4\n");
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(refused("-k*x"), "");
  EXPECT_THAT(refused("-k*x + cos(phase)"), HasSubstr("the model needs its period"));
  for (const char* const place :
       {"[surfaces.wall]\nwhen = \"x - cos(phase)\"\nreset = {v = \"-v\"}",
        "[surfaces.wall]\nwhen = \"x\"\nreset = {v = \"-v*cos(phase)\"}",
        "[sections.top]\nwhen = \"x - cos(phase)\""}) {
    EXPECT_THAT(refused("-k*x\"\n" + std::string(place) + "\n#"),
                HasSubstr("the model needs its period"))
        << place;
  }
}

// A cycle that is longer than the record is found in longer ones, and so are its extremes. Radau at
// 1e-11 gives 753.99391678 and 6.36271982.
TEST(Clockless, ACycleHasItsExtremesWhereTheRecordIsAPartOfIt) {
  const SweepResult result =
      run("[model]\nname = 'lugre'\n[[axes]]\nname = 'pull'\nvalues = [100.0]\n[integrate]\n"
          "settle = 400\nrecord = 60\n[observe]\n"
          "quantities = ['motion_class', 'cycle_time', 'e_max']\n");
  EXPECT_EQ(map_of(result, "motion_class")[0], MOTION_periodic);
  EXPECT_NEAR(map_of(result, "cycle_time")[0], 6.36271982, 1e-5);
  EXPECT_NEAR(map_of(result, "e_max")[0], 753.99391678, 1e-4);
}

void expect_rest(const SweepResult& result) {
  EXPECT_THAT(map_of(result, "motion_class"), ::testing::Each(MOTION_equilibrium));
  EXPECT_THAT(map_of(result, "period"), ::testing::Each(0.0));
  EXPECT_THAT(map_of(result, "maxima_returns"), ::testing::Each(0.0));
}

// Friction holds a mass wherever it stops: no exponent tells that it rests.
TEST(Clockless, WhatSticksForEverIsAtRest) {
  for (const char* engine : {"opencl", "reference"}) {
    const SweepResult result = run(fmt::format(
        "[model]\ntext = \"\"\"\n[model]\nname = 'dry'\n[states]\nx = {{ start = 1.0 }}\nv = {{}}\n"
        "[parameters]\nmu = 0.1\n[equations]\nx = 'v'\nv = '-x - mu*sign(v)'\n\"\"\"\n"
        "[[axes]]\nname = 'mu'\nvalues = [0.05, 0.11, 0.3]\n[integrate]\nengine = '{}'\n[observe]\n"
        "quantities = ['motion_class', 'period', 'maxima_returns', 'sticking_share']\n",
        engine));
    SCOPED_TRACE(engine);
    expect_rest(result);
    EXPECT_THAT(map_of(result, "sticking_share"),
                ::testing::Each(::testing::DoubleNear(1.0, 1e-9)));
  }
}

// So does a plate a ball that has come to rest on it.
TEST(Clockless, ABallThatHasStoppedIsAtRest) {
  for (const char* engine : {"opencl", "reference"}) {
    const SweepResult result = run(fmt::format(
        "[model]\ntext = \"\"\"\n[model]\nname = 'ball'\n[states]\nz = {{ start = 1.0 }}\nv = "
        "{{}}\n"
        "[parameters]\nr = 0.5\n[equations]\nz = 'v'\nv = '-1'\n[surfaces.plate]\nwhen = '-z'\n"
        "reset = {{ v = '-r*v' }}\n\"\"\"\n[[axes]]\nname = 'r'\nvalues = [0.0, 0.5, 0.9]\n"
        "[integrate]\nengine = '{}'\n[observe]\n"
        "quantities = ['motion_class', 'period', 'maxima_returns', 'plate_impacts']\n",
        engine));
    SCOPED_TRACE(engine);
    expect_rest(result);
    // What was met before the record is not counted.
    EXPECT_THAT(map_of(result, "plate_impacts"), ::testing::Each(0.0)) << engine;
  }
}

// v' = I - v from 0 to 1, where it fires and begins anew: after ln(I/(I - 1)). Nothing is largest
// there but for a moment, so returns are those to the surface. Counts are per unit of time, which
// does not depend on what a study counts its time in.
TEST(Clockless, WhatFiresIsACycleAndCountsAreInTime) {
  for (const auto& [engine, other] :
       {std::pair("opencl", ""), {"reference", ""}, {"opencl", "max_step = 0.01"}}) {
    SCOPED_TRACE(std::string(engine) + other);
    const SweepResult result = run(fmt::format(
        "[model]\ntext = \"\"\"\n[model]\nname = 'fires'\n[states]\nv = {{}}\n[parameters]\n"
        "I = 2.0\n[equations]\nv = 'I - v'\n[surfaces.fire]\nwhen = 'v - 1'\n"
        "reset = {{ v = '0' }}\n\"\"\"\n[[axes]]\nname = 'I'\nvalues = [0.5, 1.5, 3.0]\n"
        "[integrate]\nrecord = 1000\nengine = '{}'\n{}\n[observe]\nquantities = ["
        "'motion_class', 'period', 'cycle_time', 'fire_impacts', 'fire_returns', 'attractor']\n",
        engine, other));
    EXPECT_THAT(map_of(result, "motion_class"),
                ::testing::ElementsAre(MOTION_equilibrium, MOTION_periodic, MOTION_periodic));
    EXPECT_THAT(map_of(result, "period"), ::testing::ElementsAre(0.0, 1.0, 1.0));
    EXPECT_THAT(map_of(result, "attractor"), ::testing::ElementsAre(1.0, 2.0, 2.0));
    EXPECT_EQ(map_of(result, "fire_impacts")[0], 0.0);
    for (const auto& [point, current] : {std::pair(1U, 1.5), {2U, 3.0}}) {
      const double cycle = std::log(current / (current - 1.0));
      EXPECT_NEAR(map_of(result, "cycle_time")[point], cycle, 1e-6);
      EXPECT_NEAR(map_of(result, "fire_impacts")[point], 1.0 / cycle, 2e-3);
      EXPECT_NEAR(map_of(result, "fire_returns")[point], 1.0 / cycle, 2e-3);
    }
    EXPECT_EQ(result.study.model->sections.front().name, "fire");
    EXPECT_THAT(result.study.clock_reason, ::testing::HasSubstr("return"));
  }
}

std::string free_study(const std::string& model, const std::string& rest) {
  return study_of_text("[model]\nname = \"free\"\n" + model, rest);
}

// A state that stands still has no maximum, and angles have none: a rotation returns once in a
// turn.
TEST(Clockless, TheFirstStateNeedNotMove) {
  const SweepResult still = run(free_study(
      "[states]\nc = { start = 1.0 }\nx = { start = 1.0 }\ny = {}\n[parameters]\nm = 1.0\n"
      "[equations]\nc = \"0\"\nx = \"y\"\ny = \"m*c*(1 - x^2)*y - x\"\n",
      "[[axes]]\nname = 'm'\nvalues = [1.0]\n[observe]\n"
      "quantities = ['motion_class', 'cycle_time']\n"));
  EXPECT_EQ(map_of(still, "motion_class")[0], MOTION_periodic);
  EXPECT_NEAR(map_of(still, "cycle_time")[0], 6.663286859, 1e-5);
  const SweepResult turns = run(free_study(
      "[states]\nth = { angle = true }\n[parameters]\na = 0.9\n[equations]\n"
      "th = \"1 - a*cos(th)\"\n",
      "[[axes]]\nname = 'a'\nvalues = [0.9, 0.99, 1.1]\n[integrate]\nmax_step = 0.01\n[observe]\n"
      "quantities = ['motion_class', 'cycle_time']\n"));
  EXPECT_THAT(map_of(turns, "motion_class"),
              ::testing::ElementsAre(MOTION_periodic, MOTION_periodic, MOTION_equilibrium));
  for (const auto& [point, a] : {std::pair(0U, 0.9), {1U, 0.99}}) {
    const double turn = 2.0 * std::numbers::pi / std::sqrt(1.0 - a * a);
    EXPECT_NEAR(map_of(turns, "cycle_time")[point] / turn, 1.0, 1e-6);
  }
}

// Two exponents of a periodic motion that conserves its energy are 0, as a torus has them, and
// steps make it drift.
TEST(Clockless, AConservativeCycleIsNoTorus) {
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run(free_study(
        "[states]\nx = { start = 1.0 }\nv = {}\ny = { start = 1.0 }\nw = {}\n[parameters]\n"
        "om = 1.5\n[equations]\nx = \"v\"\nv = \"-x\"\ny = \"w\"\nw = \"-om^2*y\"\n",
        fmt::format("[[axes]]\nname = 'om'\nvalues = [1.0, 1.5, 1.618033988749895]\n[integrate]\n"
                    "engine = '{}'\nrecord = 1000\n[observe]\nquantities = ['motion_class']\n",
                    engine)));
    EXPECT_NE(map_of(result, "motion_class")[0], MOTION_quasi_periodic);
    EXPECT_NE(map_of(result, "motion_class")[1], MOTION_quasi_periodic);
    EXPECT_EQ(map_of(result, "motion_class")[2], MOTION_quasi_periodic);
  }
}

// A spiral into rest does not repeat, however small it has become; nor is a saddle an end.
TEST(Clockless, RestHasNoPeriodAndDoesNotGrow) {
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult spiral = run(free_study(
        "[states]\nx = { start = 1.0 }\nv = {}\n[parameters]\nz = 0.1\n[equations]\nx = \"v\"\n"
        "v = \"-x - 2*z*v\"\n",
        fmt::format("[[axes]]\nname = 'z'\nvalues = [0.05, 0.1]\n[integrate]\nengine = '{}'\n"
                    "[observe]\nquantities = ['motion_class', 'period', 'cycle_time']\n",
                    engine)));
    EXPECT_THAT(map_of(spiral, "motion_class"), ::testing::Each(MOTION_equilibrium));
    EXPECT_THAT(map_of(spiral, "period"), ::testing::Each(0.0));
    EXPECT_TRUE(std::isnan(map_of(spiral, "cycle_time")[1]));
    const SweepResult saddle = run(
        free_study("[states]\nx = {}\ny = { start = 1.0 }\n[parameters]\np = 1.0\n[equations]\n"
                   "x = \"p*x - x^3\"\ny = \"-y\"\n",
                   fmt::format("[[axes]]\nname = 'p'\nvalues = [1.0]\n[integrate]\nengine = '{}'\n"
                               "settle = 2000\n[observe]\nquantities = ['motion_class']\n",
                               engine)));
    EXPECT_EQ(map_of(saddle, "motion_class")[0], MOTION_undecided);
  }
}

// Between two impacts a state goes on as y -> a y (1 - y): two states, and chaos.
TEST(Clockless, ResetsMakeRoomForChaosInThePlane) {
  const SweepResult result = run(free_study(
      "[states]\nx = {}\ny = { start = 0.3 }\n[parameters]\na = 3.9\n[equations]\nx = \"1\"\n"
      "y = \"0\"\n[surfaces.tick]\nwhen = \"x - 1\"\nreset = { x = \"0\", y = \"a*y*(1 - y)\" }\n",
      "[[axes]]\nname = 'a'\nvalues = [3.2, 3.5, 3.9]\n[integrate]\nrecord = 1000\n[observe]\n"
      "quantities = ['motion_class', 'period']\n"));
  EXPECT_THAT(map_of(result, "motion_class"),
              ::testing::ElementsAre(MOTION_periodic, MOTION_periodic, MOTION_chaotic));
  EXPECT_THAT(map_of(result, "period"), ::testing::ElementsAre(2.0, 4.0, 0.0));
}

// r' = -r (1 - r^2) (1 - r^2/4): starts within r = 1 come to rest, all others to the cycle r = 2.
TEST(Clockless, BasinsAreThoseOfRestAndCycle) {
  const SweepResult result = run(R"toml([model]
text = """
[model]
name = "two_ends"
[states]
x = {}
y = {}
[parameters]
w = 1.0
[constants]
q = "-(1 - x^2 - y^2)*(1 - (x^2 + y^2)/4)"
[equations]
x = "q*x - w*y"
y = "w*x + q*y"
"""
[[axes]]
name = "x"
values = [-1.7, -1.1, -0.5, 0.2, 0.8, 1.4]
[[axes]]
name = "y"
values = [-2.1, -0.9, 0.3, 1.2]
[observe]
quantities = ["attractor"]
)toml");
  ASSERT_EQ(result.attractors.size(), 2U);
  EXPECT_EQ(result.attractors[0].motion, static_cast<std::size_t>(MOTION_equilibrium));
  EXPECT_EQ(result.attractors[1].motion, static_cast<std::size_t>(MOTION_periodic));
  const std::vector<double>&xs = result.study.axes[0].values, &ys = result.study.axes[1].values;
  for (std::size_t i = 0; i < result.study.points(); ++i) {
    const double r = std::hypot(xs[i % xs.size()], ys[i / xs.size()]);
    EXPECT_EQ(map_of(result, "attractor")[i], r < 1.0 ? 1.0 : 2.0) << r;
  }
}

// Roessler's cycle beside a state that decays, one that is conserved but for rounding, and one that
// saturates: in each order they are judged by a state that has peaks.
TEST(Clockless, AreJudgedByAStateThatHasPeaks) {
  for (const auto& [rate, push] : {std::pair("-0.05*s", 1.0),
                                   {"0*x", 0.0},
                                   {"x*y - y*x", 0.0},
                                   {"-20*(s - tanh(200*y))", 0.0}}) {
    for (const char* order : {"s = { start = '1' }\nx = { start = '1' }\ny = {}\nz = {}",
                              "y = {}\nz = {}\nx = { start = '1' }\ns = { start = '1' }"}) {
      SCOPED_TRACE(fmt::format("{} {}", rate, order));
      const SweepResult result = run(fmt::format(R"toml([model]
text = """
[model]
name = "beside"
[states]
{}
[parameters]
c = 2.5
[equations]
x = "-y - z + {}*s"
y = "x + 0.2*y"
z = "0.2 + z*(x - c)"
s = "{}"
"""
[[axes]]
name = "c"
values = [2.5]
[observe]
quantities = ["motion_class", "cycle_time"]
)toml",
                                                 order, push, rate));
      EXPECT_EQ(map_of(result, "motion_class")[0], MOTION_periodic);
      EXPECT_NEAR(map_of(result, "cycle_time")[0], 5.748991183, 1e-5);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
