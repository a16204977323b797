// Models whose equations jump with a state: steps are cut at the jumps, a motion that both sides
// push towards one slides along it, and tangent vectors jump as the saltation matrix has it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/run.hpp"
#include "support/study_text.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

// x'' + 2 zeta x' + x + friction sign(x') = cos(omega tau), written as a choice.
constexpr const char* kDry = R"toml([model]
name = "dry"
[states]
x = {}
v = {}
[parameters]
omega = { value = 0.7, min = 0.01 }
friction = { value = 0.3, min = 0.0 }
zeta = { value = 0.0, min = 0.0 }
[equations]
x = "v"
v = "cos(phase) - 2*zeta*v - x - if(v > 0, friction, -friction)"
[forcing]
period = "2*pi/omega"
[signals]
grip = { expression = "if(v > 0, friction, -friction)" }
)toml";

// All studies of it observe the same, so that they share a program.
std::string dry_study(const std::string& parameters, const std::string& axes,
                      const std::string& integrate) {
  return study_of_text(kDry,
                       "[parameters]\n" + parameters + axes +
                           "[initial]\npolicy = 'fixed'\nstate = { x = 1.0, v = 0.5 }\n"
                           "[integrate]\n" +
                           integrate +
                           "[observe]\npoincare = ['x', 'v']\nquantities = ['x_max', 'grip_rms', "
                           "'lyapunov_spectrum', 'poincare']\n");
}

// Den Hartog, Transactions of the ASME 53 (1931), APM-53-9: the motion that never sticks, of
// amplitude sqrt(V^2 - q^2) with V = 1/(1 - w^2) and q = -f sin(pi/w)/(w (1 + cos(pi/w))).
TEST(Jumps, HaveDenHartogsAmplitude) {
  const SweepResult result =
      run(dry_study("zeta = 0.0\n", "[[axes]]\nname = 'omega'\nvalues = [0.7, 1.3]\n",
                    "steps_per_period = 400\nsettle = 300\nrecord = 2\nstop = 'never'\n"));
  for (std::size_t i = 0; i < 2; ++i) {
    const double w = std::array{0.7, 1.3}[i], f = 0.3, turn = std::numbers::pi / w;
    const double v = 1.0 / (1.0 - w * w), q = -f * std::sin(turn) / (w * (1.0 + std::cos(turn)));
    EXPECT_NEAR(map_of(result, "x_max")[i], std::sqrt(v * v - q * q), 2e-8);
    EXPECT_NEAR(map_of(result, "grip_rms")[i], f, 1e-14);
  }
}

// Exponents of the same oscillator with damping, by steps that end at the jumps (measured outside
// of this project).
TEST(Jumps, HaveTheExponentsOfDryFriction) {
  const SweepResult result =
      run(dry_study("zeta = 0.02\n",
                    "[[axes]]\nname = 'friction'\nvalues = [0.05, 0.15, 0.3]\n"
                    "[[axes]]\nname = 'omega'\nvalues = [0.7, 1.6]\n",
                    "steps_per_period = 200\nsettle = 200\nrecord = 200\nstop = 'never'\n"));
  const std::vector<double>& spectra = map_of(result, "lyapunov_spectrum");  // two a point
  EXPECT_NEAR(spectra[0], -0.0317, 2e-4);
  EXPECT_NEAR(spectra[2], -0.0560, 2e-4);
  EXPECT_NEAR(spectra[4], -0.0976, 2e-4);
  EXPECT_NEAR(spectra[10], -0.1272, 5e-4);
}

// The motion from one turn of the velocity to the next, by Boost.odeint's controlled method, and
// the time in which it sticks in closed form.
std::array<double, 2> dry_by_pieces(double omega, double friction, double zeta, double until) {
  using State = std::array<double, 2>;
  namespace odeint = boost::numeric::odeint;
  State x = {1.0, 0.5};
  double time = 0.0, side = 1.0;
  const auto advance = [&](State from, double length) {
    const auto field = [&](const State& at, State& dx, double t) {
      dx = {at[1], std::cos(omega * t) - 2.0 * zeta * at[1] - at[0] - friction * side};
    };
    auto stepper = odeint::make_controlled<odeint::runge_kutta_fehlberg78<State>>(1e-14, 1e-14);
    if (length > 0.0) {
      odeint::integrate_adaptive(stepper, field, from, time, time + length, length / 4.0);
    }
    return from;
  };
  const auto push = [&](double at) { return std::cos(omega * at) - x[0]; };
  constexpr double kLook = 0.01;
  while (time < until) {
    const double length = std::min(kLook, until - time);
    const State next = advance(x, length);
    if (side * next[1] >= 0.0) {
      x = next;
      time += length;
      continue;
    }
    double low = 0.0, high = length;
    while (high - low > 1e-15) {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (side * advance(x, middle)[1] >= 0.0 ? low : high) = middle;
    }
    x = advance(x, high);
    time += high;
    x[1] = 0.0;
    if (std::fabs(push(time)) <= friction) {  // it sticks
      double end = time;
      while (std::fabs(push(end)) <= friction && end < until) end += kLook;
      if (end >= until && std::fabs(push(until)) <= friction) return x;
      double stuck = end - kLook;
      while (end - stuck > 1e-15) {
        const double middle = 0.5 * (stuck + end);
        if (middle <= stuck || middle >= end) break;
        (std::fabs(push(middle)) <= friction ? stuck : end) = middle;
      }
      time = end;
    }
    side = push(time) > 0.0 ? 1.0 : -1.0;
  }
  return x;
}

// Fourth order, with turns alone and with sticking.
TEST(Jumps, AreCrossedAtTheOrderOfTheMethod) {
  struct Case {
    double omega, friction, zeta;
  };
  for (const Case& at : {Case{0.7, 0.3, 0.02}, Case{0.4, 0.7, 0.02}, Case{0.3, 0.95, 0.0}}) {
    const auto exact =
        dry_by_pieces(at.omega, at.friction, at.zeta, 8.0 * std::numbers::pi / at.omega);
    const auto error = [&](std::size_t steps) {
      const SweepResult result = run(dry_study(
          fmt::format("zeta = {}\nfriction = {}\n", at.zeta, at.friction),
          fmt::format("[[axes]]\nname = 'omega'\nvalues = [{}]\n", at.omega),
          fmt::format("steps_per_period = {}\nsettle = 3\nrecord = 1\nwarm_up = 0\n", steps)));
      return std::hypot(samples_of(result, 0, 0)[0] - exact[0],
                        samples_of(result, 0, 1)[0] - exact[1]);
    };
    const double coarse = error(60), fine = error(480);
    EXPECT_LT(fine, 1e-6) << at.friction;
    EXPECT_GT(std::log2(coarse / fine) / 3.0, 3.5) << at.friction;
  }
}

// x''' + 0.5 x'' + x' + x = sign(x). Two neighbouring motions that are pieced together of their
// closed forms part at rates of 0.156, 0.160 and 0.165 over 3,000 units of time. At x = 0 a jump of
// x''' alone leaves volumes what they are.
TEST(Jumps, HaveTheExponentsOfAJerk) {
  const SweepResult result =
      run(study_of_text(R"toml([model]
name = "jerk"
[states]
x = { start = "0.1" }
y = {}
z = {}
[parameters]
a = 0.5
[equations]
x = "y"
y = "z"
z = "-a*z - y - x + sign(x)"
[forcing]
period = "1"
)toml",
                        "[[axes]]\nname = 'y'\nfrom = 0.1\nto = 0.2\ncount = 8\n"
                        "[integrate]\nsteps_per_period = 20\nsettle = 500\n"
                        "record = 8000\nextend = 1\n"
                        "[observe]\nquantities = ['lyapunov_spectrum']\n"));
  for (std::size_t i = 0; i < 8; ++i) {
    const double* const exponents = map_of(result, "lyapunov_spectrum").data() + 3 * i;
    const double first = exponents[0], second = exponents[1], third = exponents[2];
    EXPECT_NEAR(first, 0.16, 0.01);
    EXPECT_NEAR(second, 0.0, 2e-3);
    EXPECT_NEAR(first + second + third, -0.5, 1e-5);
  }
}

// A block on a belt, with friction that falls with the speed: it sticks and slips. What a tangent
// vector has across the belt's speed is lost where it sticks.
TEST(Jumps, LoseATangentVectorWhereTheMotionSticks) {
  const SweepResult result = run(study_of_text(R"toml([model]
name = "belt"
[states]
x = { start = "0.5" }
v = { start = "0.1" }
[parameters]
w = 0.3
[equations]
x = "v"
v = "-x + sign(w - v)/(1 + 3*abs(w - v))"
[forcing]
period = "1"
)toml",
                                               "[[axes]]\nname = 'w'\nvalues = [0.2, 0.3, 0.4]\n"
                                               "[integrate]\nsteps_per_period = 40\nsettle = 200\n"
                                               "record = 2000\nextend = 1\n"
                                               "[observe]\nquantities = ['lyapunov_spectrum', "
                                               "'v_max']\n"));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(map_of(result, "lyapunov_spectrum")[2 * i], 0.0, 1e-3);
    EXPECT_EQ(map_of(result, "lyapunov_spectrum")[2 * i + 1], -INFINITY);
    EXPECT_NEAR(map_of(result, "v_max")[i], 0.2 + 0.1 * static_cast<double>(i), 1e-8);
  }
}

// Two periods of x'' = law from x = 0.5, by each engine.
std::array<SweepResult, 2> controlled(const std::string& law, int steps,
                                      const std::string& quantity) {
  const std::string model = fmt::format(R"toml([model]
name = "controlled"
[states]
x = {{ start = "0.5" }}
v = {{}}
[parameters]
omega = 1.0
[equations]
x = "v"
v = "{}"
[forcing]
period = "2*pi/omega"
)toml",
                                        law);
  const auto by = [&](const char* engine) {
    return run(study_of_text(
        model,
        fmt::format("[[axes]]\nname = 'omega'\nvalues = [1.0, 1.1]\n[integrate]\nsettle = 2\n"
                    "record = 2\nstop = 'never'\nsteps_per_period = {}\nengine = '{}'\n"
                    "[observe]\nquantities = ['{}']\n",
                    steps, engine, quantity)));
  };
  return {by("opencl"), by("reference")};
}

// x'' = -2 sign(x + x'/2) + cos(tau)/2 slides along x' = -2 x for good: one exponent is -2. The
// other vector is lost though no sliding begins in the record.
TEST(Jumps, LoseATangentVectorWhereTheMotionSlidesAllTheTime) {
  for (const SweepResult& result :
       controlled("-2*sign(x + 0.5*v) + 0.5*cos(phase)", 200, "lyapunov_spectrum")) {
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(map_of(result, "lyapunov_spectrum")[2 * i], -2.0, 1e-6);
      EXPECT_EQ(map_of(result, "lyapunov_spectrum")[2 * i + 1], -INFINITY);
    }
  }
}

// Two jumps that take a motion to where they meet, in finite time and by ever faster switching:
// what is not followed to its end is no result.
TEST(Jumps, WithoutEndAreNoResult) {
  for (const SweepResult& result :
       controlled("-1.5*sign(x) - 0.7*sign(v) + 0.3*cos(phase)", 100, "x_max")) {
    EXPECT_THAT(result.status, ::testing::Each(STATUS_diverged));
  }
}

// 1 + 5 abs(r) is 0 on the side of r = 0 that the start r = -1/5 is not on. The cycle by DOP853 and
// the closed form of sticking.
TEST(Jumps, APoleOnTheOtherSideIsNotMet) {
  const SweepResult result =
      run(study_of_text("[model]\nname = \"pole\"\n[states]\nx = {}\nv = {}\n[parameters]\nvb = "
                        "0.2\n[constants]\nr = \"v - vb\"\n"
                        "[equations]\nx = \"v\"\nv = \"-x - (0.4 + 0.6/(1 + 5*abs(r)))*sign(r)\"\n",
                        "[[axes]]\nname = 'vb'\nvalues = [0.2, 0.20000000000001]\n[observe]\n"
                        "quantities = ['x_max', 'cycle_time']\n"));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(map_of(result, "x_max")[i], 1.137680, 1e-5);
    EXPECT_NEAR(map_of(result, "cycle_time")[i], 9.53749, 1e-5);
  }
}

// What stands in a jump or in a `when` alone may be faster than all states: the step that is found
// sees it. By the exact flow between the firings, their places by bisection on a fine scan.
TEST(Jumps, TheStepThatIsFoundSeesHowFastALevelIs) {
  const SweepResult fires = run(study_of_text(
      "[model]\nname = \"jumping\"\n[states]\nu = {}\n[parameters]\nomega = 1.0\n[equations]\n"
      "u = \"1.5 + 0.1*cos(phase) - u\"\n[forcing]\nperiod = \"2*pi/omega\"\n[surfaces.fire]\n"
      "when = \"u - 1 - 0.2*cos(61*phase)\"\nreset = { u = \"0\" }\n",
      "[[axes]]\nname = 'omega'\nvalues = [1.0, 2.0]\n[integrate]\nsettle = 20\nrecord = 20\n"
      "[observe]\nquantities = ['u_max', 'fire_impacts', 'fire_impact_speed']\n"));
  EXPECT_NEAR(map_of(fires, "u_max")[0], 0.8658, 1e-4);
  EXPECT_NEAR(map_of(fires, "u_max")[1], 0.8337, 1e-4);
  EXPECT_EQ(map_of(fires, "fire_impacts")[0], 7.85);
  EXPECT_NEAR(map_of(fires, "fire_impact_speed")[1], 14.32, 0.01);
}

// On a periodic orbit exponents are those of the multipliers, which a jump changes by the saltation
// matrix; a point stops there. Damping 0.04, friction 0.3; by a program of its own.
TEST(Jumps, ExponentsOfPeriodicOrbitsAreThoseOfTheMultipliers) {
  const SweepResult result = run(study_of_text(
      "[model]\nname = \"jumping\"\n[states]\nx = {}\nv = {}\n[parameters]\nomega = 0.7\nmu = "
      "0.3\n[equations]\nx = \"v\"\n"
      "v = \"cos(phase) - x - 0.04*v - mu*sign(v)\"\n[forcing]\nperiod = \"2*pi/omega\"\n",
      "[[axes]]\nname = 'omega'\nvalues = [0.7, 1.6]\n[observe]\n"
      "quantities = ['lyapunov_max', 'lyapunov_max_error', 'period']\n"));
  for (const auto& [point, exponent] : {std::pair(0U, -0.0976), {1U, -0.1272}}) {
    EXPECT_EQ(map_of(result, "period")[point], 1.0);
    EXPECT_NEAR(map_of(result, "lyapunov_max")[point], exponent, 1e-4);
    EXPECT_LT(map_of(result, "lyapunov_max_error")[point], 1e-3);
  }
  EXPECT_GT(result.stopped, 0U);
}

}  // namespace
}  // namespace gearsweep::testing
