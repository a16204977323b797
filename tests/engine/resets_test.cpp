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
