// How often a motion meets a surface and how fast, and how long it stays at one. Closed forms stand
// in the files of the zoo.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "study/refusal.hpp"
#include "support/run.hpp"
#include "support/study_text.hpp"

namespace gearsweep::testing {
namespace {

struct LookedAt {
  const char *model, *axis, *quantities;
  double tolerance;
};

TEST(SurfaceQuantities, AreTheSameInBothEnginesAndInEachLane) {
  const std::string own = "'sticking_share', 'sticking_stops'";
  const std::array cases = {
      LookedAt{"coulomb", "name = 'omega'\nfrom = 0.2\nto = 1.2", "'x_max'", 1e-6},
      LookedAt{"belt", "name = 'w'\nfrom = 0.1\nto = 0.5", "'x_min'", 1e-5},
      LookedAt{"hard_impact", "name = 'x'\nfrom = -0.9\nto = -0.1",
               "'wall_impacts', 'wall_impact_speed'", 1e-6},
  };
  for (const LookedAt& one : cases) {
    SCOPED_TRACE(one.model);
    const std::string study = fmt::format(
        "[model]\nname = '{}'\n[[axes]]\n{}\ncount = 8\n[integrate]\nsettle = 0\nrecord = 4\n"
        "steps_per_period = 256\nstop = 'never'\n[observe]\nquantities = [{}, {}]\n",
        one.model, one.axis, own, one.quantities);
    const SweepResult kernel = run(study, {"integrate.lanes=8"});
    const SweepResult reference = run(study, {"integrate.engine=reference"});
    const SweepResult alone = run(study, {"integrate.lanes=1"});
    for (std::size_t q = 0; q < kernel.values.size(); ++q) {
      for (std::size_t i = 0; i < kernel.status.size(); ++i) {
        EXPECT_NEAR(kernel.values[q][i], reference.values[q][i], one.tolerance) << q;
        EXPECT_EQ(kernel.values[q][i], alone.values[q][i]) << q;
      }
    }
  }
}

// Each lane cuts its steps where it meets a surface, so orders have phases lane by lane there.
TEST(SurfaceQuantities, OrdersAreTheSameInBothEnginesAndInEachLane) {
  for (const auto& [model, axis] :
       {std::pair{"coulomb", "name = 'omega'\nfrom = 0.7\nto = 1.0"},
        std::pair{"hard_impact", "name = 'x'\nfrom = -0.9\nto = -0.1"}}) {
    SCOPED_TRACE(model);
    const std::string study = fmt::format(
        "[model]\nname = '{}'\n[[axes]]\n{}\ncount = 8\n[integrate]\nsettle = 4\nrecord = 4\n"
        "steps_per_period = 256\nstop = 'never'\n[observe]\nquantities = ['x_order_amplitude']\n",
        model, axis);
    const SweepResult reference = run(study, {"integrate.engine=reference"});
    for (const char* lanes : {"1", "2", "4", "8"}) {
      const SweepResult kernel = run(study, {std::string("integrate.lanes=") + lanes});
      const std::vector<double>& amplitudes = map_of(kernel, "x_order_amplitude");
      ASSERT_EQ(amplitudes.size(), 24U);
      for (std::size_t i = 0; i < amplitudes.size(); ++i) {
        EXPECT_NEAR(amplitudes[i], map_of(reference, "x_order_amplitude")[i], 1e-6)
            << lanes << " lanes, " << i;
      }
    }
  }
}

// A block that is dragged by another one, which sticks to the floor at times. Where it comes to
// rest on both, the friction that would hold it there may be more than there is: it shows nowhere.
TEST(SurfaceQuantities, FrictionNeverExceedsItsBound) {
  constexpr const char* kBlocks = R"toml([model]
text = """
[model]
name = "block_on_block"
[states]
x1 = {}
x2 = {}
v1 = {}
v2 = {}
[parameters]
omega = 0.8
F = 0.6
[constants]
floor_force = "0.5*sign(v1)"
drag = "0.4*sign(v2 - v1)"
[equations]
x1 = "v1"
x2 = "v2"
v1 = "drag - floor_force - x1 + 0.5*(x2 - x1)"
v2 = "(F*cos(phase) - drag - 0.5*(x2 - x1))/0.6"
[forcing]
period = "2*pi/omega"
[signals]
between = "drag"
"""
[[axes]]
name = "omega"
values = [0.6, 0.8, 1.1]
[[axes]]
name = "F"
values = [0.6, 1.0]
[integrate]
settle = 60
record = 10
stop = "never"
[observe]
quantities = ["between_max", "between_min", "sticking_share"]
)toml";
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run(kBlocks, {fmt::format("integrate.engine='{}'", engine)});
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(map_of(result, "between_max")[i], 0.4, 1e-7) << i;
      EXPECT_NEAR(map_of(result, "between_min")[i], -0.4, 1e-7) << i;
    }
    EXPECT_GT(map_of(result, "sticking_share")[2], 0.5);
  }
}

// On its orbit a point is recorded for a turn alone.
TEST(SurfaceQuantities, DoNotDependOnHowLongIsRecorded) {
  const std::string study =
      "[model]\nname = 'coulomb'\npreset = 'sticking'\n[[axes]]\nname = 'omega'\nfrom = 0.3\n"
      "to = 0.5\ncount = 4\n[observe]\nquantities = ['sticking_share', 'sticking_stops']\n";
  const SweepResult early = run(study), late = run(study, {"integrate.stop=never"});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(map_of(early, "sticking_share")[i], map_of(late, "sticking_share")[i], 1e-7);
    EXPECT_NEAR(map_of(early, "sticking_stops")[i], map_of(late, "sticking_stops")[i], 1e-12);
  }
}

// A motion that slides along x = 0 has the share p of its time above, by Filippov: signals are the
// means of what they are on both sides, however they are written, and whatever is done with them.
TEST(SurfaceQuantities, SignalsOfASlidingMotionAreMeansOfBothSides) {
  const std::string model =
      "[model]\nname = \"slide\"\n[states]\nx = { start = -1.0 }\ny = {}\n[parameters]\n"
      "p = 0.3\nq = 2.0\n[equations]\nx = \"p - step(x)\"\ny = \"step(x) - y\"\n[signals]\n"
      "by_step = \"step(x)\"\nby_if = \"q*if(x > 0, 3, 1) - y\"\nby_sign = \"0.5 + 0.5*sign(x)\"\n"
      "squared = \"(1 + sign(x))^2 - 3*step(x)\"\ninside = \"cos(q*if(x < 0, 0, 1))\"\n"
      "both = \"if(x > 0 and y < q, q, abs(sign(x)))\"\n";
  for (const char* engine : {"opencl", "reference"}) {
    SCOPED_TRACE(engine);
    const SweepResult result = run(study_of_text(
        model, fmt::format("[[axes]]\nname = 'p'\nvalues = [0.3, 0.6]\n[integrate]\nengine = '{}'\n"
                           "settle = 50\nrecord = 20\nmax_step = 0.05\n[observe]\n"
                           "quantities = ['by_step_mean', 'by_if_max', 'by_sign_rms', "
                           "'squared_mean', 'inside_min', 'both_mean']\n",
                           engine)));
    for (const auto& [i, p] : {std::pair(0U, 0.3), {1U, 0.6}}) {
      EXPECT_NEAR(map_of(result, "by_step_mean")[i], p, 1e-12);
      EXPECT_NEAR(map_of(result, "by_if_max")[i], 2.0 * (1.0 + 2.0 * p) - p, 1e-9);
      EXPECT_NEAR(map_of(result, "by_sign_rms")[i], p, 1e-12);
      EXPECT_NEAR(map_of(result, "squared_mean")[i], p, 1e-12);
      EXPECT_NEAR(map_of(result, "inside_min")[i], p * std::cos(2.0) + 1.0 - p, 1e-12);
      EXPECT_NEAR(map_of(result, "both_mean")[i], 1.0 + p, 1e-12);
    }
  }
}

TEST(SurfaceQuantities, AreThoseOfModelsThatHaveSome) {
  const auto refused = [](const std::string& model, const std::string& quantity) {
    return refusal(
        fmt::format("[model]\nname = '{}'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1\n"
                    "count = 4\n[observe]\nquantities = ['{}']\n",
                    model, quantity));
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused("duffing", "sticking_share"), HasSubstr("unknown quantity"));
  EXPECT_THAT(refused("coulomb", "wall_impacts"), HasSubstr("unknown quantity"));
  EXPECT_EQ(refused("coulomb", "sticking_stops"), "");
}

}  // namespace
}  // namespace gearsweep::testing
