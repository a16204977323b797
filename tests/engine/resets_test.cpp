// Surfaces where the state is reset: impacts with restitution, against motions that are pieced
// together of their closed forms.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "study/refusal.hpp"
#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// x'' + x = cos(omega tau) with a wall at x = 0.
constexpr const char* kImpact = R"toml([model]
name = "impact"
[states]
x = { start = "-0.2" }
v = {}
[parameters]
omega = { value = 4.0, min = 0.01 }
r = { value = 0.8, min = 0.0, max = 1.0 }
[equations]
x = "v"
v = "cos(phase) - x"
[forcing]
period = "2*pi/omega"
[surfaces.wall]
when = "x"
reset = { v = "-r*v" }
)toml";

std::string impact_study(const std::string& axis, const std::string& integrate,
                         const std::string& model = kImpact) {
  return "[model]\ntext = '''\n" + model + "'''\n[[axes]]\n" + axis + "[integrate]\n" + integrate +
         "[observe]\npoincare = ['x', 'v']\n"
         "quantities = ['x_max', 'lyapunov_spectrum', 'period', 'motion_class', 'poincare']\n";
}

struct Place {
  double x, v;
};

// From one impact to the next in closed form; the time of an impact by halving.
Place by_pieces(double omega, double r, double until) {
  const double forced = 1.0 / (1.0 - omega * omega);
  double time = 0.0;
  Place at = {-0.2, 0.0};
  const auto free = [&](double later) {
    const double a = at.x - forced * std::cos(omega * time),
                 b = at.v + forced * omega * std::sin(omega * time);
    return Place{
        forced * std::cos(omega * (time + later)) + a * std::cos(later) + b * std::sin(later),
        -forced * omega * std::sin(omega * (time + later)) - a * std::sin(later) +
            b * std::cos(later)};
  };
  while (time < until) {
    constexpr double kLook = 1e-3;
    double later = std::min(kLook, until - time);
    while (free(later).x <= 0.0 && time + later < until)
      later = std::min(later + kLook, until - time);
    if (free(later).x <= 0.0) return free(later);
    double low = std::max(0.0, later - kLook), high = later;
    for (double middle = 0.5 * (low + high); low < middle && middle < high;
         middle = 0.5 * (low + high)) {
      (free(middle).x <= 0.0 ? low : high) = middle;
    }
    const Place hit = free(high);
    time += high;
    at = {0.0, -r * hit.v};
  }
  return at;
}

TEST(Resets, AreMetAtTheOrderOfTheMethod) {
  for (const double omega : {2.2, 2.9, 4.0}) {
    const Place exact = by_pieces(omega, 0.8, 12.0 * std::numbers::pi / omega);
    const auto error = [&](std::size_t steps) {
      const SweepResult result = run(impact_study(
          fmt::format("name = 'omega'\nvalues = [{}]\n", omega),
          fmt::format("settle = 5\nrecord = 1\nwarm_up = 0\nsteps_per_period = {}\n", steps)));
      return std::hypot(samples_of(result, 0, 0)[0] - exact.x,
                        samples_of(result, 0, 1)[0] - exact.v);
    };
    const double coarse = error(40), fine = error(320);
    EXPECT_LT(fine, 1e-6) << omega;
    EXPECT_GT(std::log2(coarse / fine) / 3.0, 3.5) << omega;
  }
}

// A motion that begins beyond a wall comes back through it and knows nothing of it.
TEST(Resets, LetAMotionFromBeyondTheWallBack) {
  const double omega = 3.5, forced = 1.0 / (1.0 - omega * omega);
  const double period = 2.0 * std::numbers::pi / omega;
  const auto error = [&](std::size_t steps) {
    const SweepResult result = run(impact_study(
        fmt::format("name = 'x'\nfrom = 0.2\nto = 2.1\ncount = 8\n[parameters]\nomega = {}\n",
                    omega),
        fmt::format("settle = 0\nrecord = 1\nwarm_up = 0\nsteps_per_period = {}\n", steps)));
    double worst = 0.0;
    for (std::size_t i = 0; i < 8; ++i) {
      const double start = 0.2 + 1.9 * static_cast<double>(i) / 7.0;
      const double x = forced + (start - forced) * std::cos(period);
      worst = std::max(worst, std::abs(samples_of(result, i, 0)[0] - x));
    }
    return worst;
  };
  const double coarse = error(40), fine = error(320);
  EXPECT_LT(fine, 1e-8);
  EXPECT_GT(std::log2(coarse / fine) / 3.0, 3.5);
}

// S. W. Shaw, P. J. Holmes, Journal of Sound and Vibration 90 (1983) 129-155: between resonances
// the motion repeats after two periods, with one impact. Each impact shrinks areas by r^2.
TEST(Resets, HaveTheMotionsOfAnImpactOscillator) {
  const SweepResult result =
      run(impact_study("name = 'omega'\nvalues = [3.4, 3.6, 3.8, 4.0, 4.2, 4.4]\n",
                       "steps_per_period = 100\nsettle = 400\nrecord = 100\n"));
  for (std::size_t i = 0; i < 6; ++i) {
    const double omega = 3.4 + 0.2 * static_cast<double>(i);
    EXPECT_EQ(map_of(result, "period")[i], 2.0) << omega;
    EXPECT_EQ(map_of(result, "motion_class")[i], 1.0) << omega;
    const double* const exponents = map_of(result, "lyapunov_spectrum").data() + 2 * i;
    EXPECT_NEAR(exponents[0] + exponents[1], 2.0 * std::log(0.8) * omega / (4.0 * std::numbers::pi),
                1e-6);
    EXPECT_NEAR(map_of(result, "x_max")[i], 0.0, 1e-7);
  }
}

constexpr const char* kBall = R"toml([model]
name = "ball"
[states]
z = { start = "-1.0" }
v = {}
[parameters]
omega = { value = 1.0, min = 0.01 }
r = { value = 0.5, min = 0.0, max = 1.0 }
a = { value = 0.0, min = 0.0 }
[constants]
w = "-a*omega*sin(phase)"
[equations]
z = "v"
v = "1"
[forcing]
period = "2*pi/omega"
[surfaces.ground]
when = "z - a*cos(phase)"
reset = { v = "w - r*(v - w)" }
)toml";

// A ball that falls by 1 bounces until sqrt(2)(1 + r)/(1 - r), infinitely often, and then rests.
TEST(Resets, EndInContact) {
  for (const char* const engine : {"opencl", "reference"}) {
    const SweepResult result = run(
        "[model]\ntext = '''\n" + std::string(kBall) +
        "'''\n[[axes]]\nname = 'r'\nvalues = [0.0, 0.3, 0.7, 0.9]\n[integrate]\nsettle = 0\n"
        "record = 6\nstop = 'never'\nwarm_up = 0\nsteps_per_period = 100\nengine = '" +
        engine +
        "'\n[observe]\npoincare = ['z', 'v']\nquantities = ['poincare', 'lyapunov_spectrum']\n");
    for (std::size_t i = 0; i < 4; ++i) {
      const double r = std::vector{0.0, 0.3, 0.7, 0.9}[i];
      const double end = std::sqrt(2.0) * (1.0 + r) / (1.0 - r);
      for (std::size_t period = 1; period <= 6; ++period) {
        const bool rests = 2.0 * std::numbers::pi * static_cast<double>(period) > end;
        const double z = samples_of(result, i, 0)[period - 1],
                     v = samples_of(result, i, 1)[period - 1];
        EXPECT_EQ(std::fabs(z) < 1e-12 && std::fabs(v) < 1e-12, rests) << r << " " << period;
      }
      EXPECT_EQ(map_of(result, "lyapunov_spectrum")[2 * i], -INFINITY) << engine << r;
    }
  }
}

// On a table that shakes gently the ball moves with it; where the table falls faster than the ball,
// it leaves.
TEST(Resets, FollowASurfaceThatMoves) {
  const SweepResult result =
      run("[model]\ntext = '''\n" + std::string(kBall) +
          "'''\n[[axes]]\nname = 'a'\nvalues = [0.5, 0.9, 1.1]\n[integrate]\nsettle = 40\n"
          "record = 2\nstop = 'never'\nsteps_per_period = 200\n"
          "[observe]\npoincare = ['z', 'v']\nquantities = ['poincare', 'z_max', 'v_max']\n");
  for (std::size_t i = 0; i < 3; ++i) {
    const double a = std::vector{0.5, 0.9, 1.1}[i];
    EXPECT_LE(map_of(result, "z_max")[i], a + 1e-9);
    if (a > 1.0) {
      EXPECT_GT(map_of(result, "v_max")[i], a + 1e-3);
    } else {
      EXPECT_NEAR(samples_of(result, i, 0)[1], a, 1e-10);
      EXPECT_NEAR(map_of(result, "v_max")[i], a, 1e-6);
    }
  }
}

// Balls that bounce, come to rest and leave again, in all ways that a gentle and a wild table bring
// about, are never above it but for what the steps leave of its height. Fell one through, it would
// be thousands above.
TEST(Resets, LetNoBallThroughTheTable) {
  const std::string model = std::string(kBall) + "[signals]\nabove = \"z - a*cos(phase)\"\n";
  for (const std::string precision : {"fp64", "fp32"}) {
    const SweepResult result =
        run("[model]\ntext = '''\n" + model +
            "'''\n[[axes]]\nname = 'a'\nfrom = 0.0\nto = 3.0\ncount = 24\n"
            "[[axes]]\nname = 'r'\nfrom = 0.0\nto = 0.95\ncount = 24\n"
            "[initial]\npolicy = 'fixed'\nstate = { z = -3.5, v = 0.1 }\n"
            "[integrate]\nsettle = 20\nrecord = 40\nstop = 'never'\nsteps_per_period = 60\n"
            "precision = '" +
            precision + "'\n[observe]\nquantities = ['above_max', 'above_min']\n");
    std::size_t refused = 0;
    for (std::size_t i = 0; i < result.status.size(); ++i) {
      if (result.status[i] != STATUS_ok) {
        ++refused;
        continue;
      }
      EXPECT_LE(map_of(result, "above_max")[i], 1e-4) << precision << " " << i;
    }
    // In fp32 a few rest so lightly that rounding lets them bounce without end.
    EXPECT_LE(refused, precision == "fp64" ? 0U : 12U) << precision;
  }
}

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

TEST(Resets, SayWhatIsWrongWithThem) {
  const auto refused = [](const std::string& surface) {
    std::string model = kImpact;
    model.replace(model.find("[surfaces.wall]"), std::string::npos, surface);
    return refusal(impact_study("name = 'omega'\nvalues = [4.0, 4.1]\n", "settle = 1\n", model));
  };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused("[surfaces.wall]\nreset = { v = '-v' }\n"), HasSubstr("says not where"));
  EXPECT_THAT(refused("[surfaces.wall]\nwhen = 'x'\n"), HasSubstr("says not what happens"));
  EXPECT_THAT(refused("[surfaces.wall]\nwhen = 'x'\nreset = { w = '-v' }\n"),
              HasSubstr("'w' is not a state"));
  EXPECT_THAT(refused("[surfaces.wall]\nwhen = 'y'\nreset = { v = '-v' }\n"),
              HasSubstr("unknown name 'y'"));
  for (const char* const when : {"sign(x)", "if(x > 0, x, v)", "x - floor(v)"}) {
    EXPECT_THAT(
        refused(fmt::format("[surfaces.wall]\nwhen = '{}'\nreset = {{ v = '-v' }}\n", when)),
        HasSubstr("may jump"))
        << when;
  }
  for (const char* const when : {"1", "cos(phase)"}) {
    EXPECT_THAT(
        refused(fmt::format("[surfaces.wall]\nwhen = '{}'\nreset = {{ v = '-v' }}\n", when)),
        HasSubstr("lies nowhere"))
        << when;
  }
  EXPECT_THAT(refused("[surfaces.x]\nwhen = 'x'\nreset = { v = '-v' }\n"), HasSubstr("'x'"));
}

}  // namespace
}  // namespace gearsweep::testing
