// Surfaces whose reset puts the state elsewhere: beyond other surfaces, and where friction holds
// it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// Izhikevich's neuron, IEEE Transactions on Neural Networks 14 (2003) 1569-1572: a reset that puts
// both states elsewhere. By the reference engine at a tenth of the step.
TEST(Resets, MayPutTheStateElsewhere) {
  const std::string model = R"toml([model]
name = "neuron"
[states]
v = { start = "-65.0" }
u = { start = "-13.0" }
[parameters]
I = { value = 10.0, min = 0.0 }
[equations]
v = "0.04*v^2 + 5*v + 140 - u + I"
u = "0.02*(0.2*v - u)"
[forcing]
period = "20"
[surfaces.spike]
when = "v - 30"
reset = { v = "-65", u = "u + 8" }
)toml";
  const auto with = [&](const std::string& integrate) {
    return run("[model]\ntext = '''\n" + model +
               "'''\n[[axes]]\nname = 'I'\nvalues = [6.0, 10.0]\n[integrate]\nsettle = 0\n"
               "record = 5\nstop = 'never'\nwarm_up = 0\n" +
               integrate +
               "[observe]\npoincare = ['v', 'u']\nquantities = ['poincare', 'v_max']\n");
  };
  const SweepResult device = with("steps_per_period = 400\n"),
                    host = with("steps_per_period = 4000\nengine = 'reference'\n");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(map_of(device, "v_max")[i], 30.0, 1e-3);
    EXPECT_NEAR(samples_of(device, i, 1)[4], samples_of(host, i, 1)[4], 1e-3);
  }
}

// x' = 1, y' = rate: what two events make of it, by their definitions.
std::vector<double> by_events(double rate, bool is_saw, double until) {
  double time = 0.0, x = 0.03, y = 0.0, z = 0.0;
  while (true) {
    const double to_first = 2.0 - x;
    const double to_second = is_saw ? (x <= 1.0 ? 1.0 - x : 1e9) : (1.0 - y) / rate;
    const double later = std::min({to_first, to_second, until - time});
    time += later;
    x += later;
    y += rate * later;
    if (time >= until) return {x, y, z};
    if (is_saw) {
      to_first <= to_second ? (void)(x = 0.0) : (void)(x += 0.5, y += 1.0);
      continue;
    }
    if (to_first <= to_second) {
      x = 0.0;
      y += 1.0;
    }
    if (to_second < to_first || y > 1.0) {
      y -= 1.0;
      z += 1.0;
    }
  }
}

std::string event_study(const char* rate, const char* surfaces, const std::string& integrate) {
  return fmt::format(R"toml([model]
text = """
[model]
name = "events"
[states]
x = {{ start = "0.03" }}
y = {{}}
z = {{}}
[parameters]
time = {{ value = 1.0, min = 0.01 }}
[equations]
x = "1"
y = "{}"
z = "0"
[forcing]
period = "time"
{}"""
[[axes]]
name = "time"
values = [1.0]
[integrate]
settle = 0
record = 12
stop = "never"
warm_up = 0
steps_per_period = 20
{}
[observe]
quantities = ["poincare", "first_impacts", "second_impacts"]
poincare = ["x", "y", "z"]
)toml",
                     rate, surfaces, integrate);
}

// A reset may put the state below a surface, which counts as left, or above one, which is met at
// the same moment.
TEST(Resets, TakeTheStateToTheOtherSideOfOtherSurfaces) {
  constexpr const char* kSaw =
      "[surfaces.first]\nwhen = \"x - 2\"\nreset = { x = \"0\" }\n"
      "[surfaces.second]\nwhen = \"x - 1\"\nreset = { x = \"x + 0.5\", y = \"y + 1\" }\n";
  constexpr const char* kLift =
      "[surfaces.first]\nwhen = \"x - 2\"\nreset = { x = \"0\", y = \"y + 1\" }\n"
      "[surfaces.second]\nwhen = \"y - 1\"\nreset = { y = \"y - 1\", z = \"z + 1\" }\n";
  for (const bool is_saw : {true, false}) {
    for (const char* engine : {"opencl", "reference"}) {
      SCOPED_TRACE(engine);
      const SweepResult result = run(event_study(is_saw ? "0" : "0.31", is_saw ? kSaw : kLift,
                                                 fmt::format("engine = '{}'", engine)));
      for (std::size_t period = 0; period < 12; ++period) {
        const std::vector<double> exact =
            by_events(is_saw ? 0.0 : 0.31, is_saw, static_cast<double>(period + 1));
        for (std::size_t state = 0; state < 3; ++state) {
          EXPECT_NEAR(samples_of(result, 0, state)[period], exact[state], 1e-9)
              << is_saw << ' ' << period << ' ' << state;
        }
      }
      const double met = by_events(is_saw ? 0.0 : 0.31, is_saw, 12.0)[is_saw ? 1 : 2];
      EXPECT_NEAR(map_of(result, "second_impacts")[0], met / 12.0, 1e-12);
    }
  }
}

struct DryImpact {
  double omega, friction, gap, r;
  double share, speed, lowest;  // of sticking; of impacts; of x
};

// x'' + x + friction sign(x') = cos(omega tau), x < gap: friction holds a mass at the wall as the
// wall does. Pieces in closed form from event to event, by a program of its own.
TEST(Resets, AndDryFrictionHoldTheSameSpeed) {
  for (const DryImpact& exact :
       {DryImpact{2.553, 0.703, -0.026, 0.0, 0.379960564837, 0.159235343424, -0.0756271619361},
        DryImpact{0.237, 0.211, 0.007, 0.825, 0.187870033239, 0.305002627608, -1.06585571149},
        DryImpact{0.385, 0.333, 0.037, 0.0, 0.525220945163, 0.705208671274, -1.17286423866},
        DryImpact{0.709, 0.872, -0.083, 0.869, 0.648488279449, 0.0691932857145,
                  -0.0987071459173}}) {
    for (const char* engine : {"opencl", "reference"}) {
      SCOPED_TRACE(fmt::format("{} {}", engine, exact.omega));
      const SweepResult result =
          run(fmt::format(R"toml([model]
text = """
[model]
name = "dry_impact"
[states]
x = {{ start = "-0.2" }}
v = {{}}
[parameters]
omega = {}
friction = {}
gap = {}
r = {}
[equations]
x = "v"
v = "cos(phase) - x - friction*sign(v)"
[forcing]
period = "2*pi/omega"
[surfaces.wall]
when = "x - gap"
reset = {{ v = "-r*v" }}
"""
[[axes]]
name = "omega"
values = [{}]
[integrate]
settle = 5
record = 1
stop = "never"
warm_up = 0
max_step = 0.02
engine = "{}"
[observe]
quantities = ["sticking_share", "wall_impact_speed", "x_min", "x_max"]
)toml",
                          exact.omega, exact.friction, exact.gap, exact.r, exact.omega, engine));
      // With restitution the other program bounces on for ever, where this one rests.
      if (exact.r == 0.0) {
        EXPECT_NEAR(map_of(result, "sticking_share")[0], exact.share, 2e-4);
      }
      EXPECT_NEAR(map_of(result, "wall_impact_speed")[0], exact.speed, 2e-4);
      EXPECT_NEAR(map_of(result, "x_min")[0], exact.lowest, 1e-6);
      EXPECT_NEAR(map_of(result, "x_max")[0], exact.gap, 1e-7);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
