// Points that stop on periodic orbits with shorter steps there than those of the run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "support/run.hpp"
#include "support/text.hpp"
#include "sweep/trace_run.hpp"

namespace gearsweep::testing {
namespace {

const std::string kLinear =
    "[model]\nname = 'duffing'\n[parameters]\ndamping = 0.1\ncubic = 0.0\namplitude = 0.7\n"
    "omega = 1.3\n[[axes]]\nname = 'linear'\nfrom = 0.5\nto = 4.0\ncount = 20\n"
    "[integrate]\nsettle = 500\nsteps_per_period = 16\n[observe]\n"
    "quantities = ['x_rms', 'lyapunov_max', 'lyapunov_max_error']\n";

const std::string kImpacting =
    "[model]\npreset = 'coarse'\n[parameters]\nb = 1.0\n[[axes]]\nname = 'omega'\n"
    "from = 0.5\nto = 1.1\ncount = 40\n[integrate]\nmax_step = 0.2\n[observe]\n"
    "quantities = ['lyapunov_max', 'lyapunov_max_error', 'period', 'x1_rms', 'x1_max']\n";

// Of x'' + 0.1 x' + s x = 0.7 cos(1.3 t): the rms of the orbit, and a decay of 0.05 at all s, in
// closed form.
double exact_rms(double s) {
  return 0.7 / std::abs(std::complex<double>(s - 1.69, 0.13)) / std::numbers::sqrt2;
}

TEST(OrbitSteps, TellTheOrbitOfALinearOscillatorAsShorterStepsDo) {
  const SweepResult long_steps = run(kLinear);
  const SweepResult fine = run(kLinear, {"integrate.orbit_steps=8"});
  const SweepResult all_short = run(kLinear, {"integrate.steps_per_period=128"});
  for (std::size_t i = 0; i < fine.status.size(); ++i) {
    const double s = fine.study.axes[0].values[i];
    ASSERT_EQ(fine.on_orbit[i], 1);
    const auto off = [&](const SweepResult& result) {
      return std::abs(map_of(result, "x_rms")[i] - exact_rms(s));
    };
    const auto exponent_off = [&](const SweepResult& result) {
      return std::abs(map_of(result, "lyapunov_max")[i] + 0.05);
    };
    // Fourth order: 8^4 = 4096 times nearer.
    EXPECT_LT(off(fine), off(long_steps) / 1000.0 + 1e-13) << s;
    EXPECT_NEAR(map_of(fine, "x_rms")[i], map_of(all_short, "x_rms")[i], 1e-9) << s;
    EXPECT_NEAR(exponent_off(fine), exponent_off(all_short), 1e-10) << s;
    EXPECT_LE(exponent_off(fine), 2.0 * map_of(fine, "lyapunov_max_error")[i] + 1e-12) << s;
  }
}

// With impacts, periods of more than one: where a run with steps as short all the way ends on the
// same orbit, the numbers are the same.
TEST(OrbitSteps, TellOrbitsWithImpactsAsShorterStepsDo) {
  const SweepResult fine = run(kImpacting, {"integrate.orbit_steps=8"});
  const SweepResult all_short = run(kImpacting, {"integrate.max_step=0.025"});
  std::size_t same = 0, with_turns = 0;
  for (std::size_t i = 0; i < fine.status.size(); ++i) {
    if (fine.on_orbit[i] == 0 || all_short.on_orbit[i] == 0) continue;
    const double period = map_of(fine, "period")[i];
    if (period != map_of(all_short, "period")[i]) continue;
    // Other orbits of the same period are far away.
    if (std::abs(map_of(fine, "x1_rms")[i] - map_of(all_short, "x1_rms")[i]) > 1e-3) continue;
    ++same;
    if (period > 1.0) ++with_turns;
    const double omega = fine.study.axes[0].values[i];
    for (const char* quantity : {"x1_rms", "x1_max"}) {
      EXPECT_NEAR(map_of(fine, quantity)[i], map_of(all_short, quantity)[i], 1e-8)
          << quantity << ' ' << omega;
    }
    // Their steps are not quite the same ones.
    EXPECT_LE(
        std::abs(map_of(fine, "lyapunov_max")[i] - map_of(all_short, "lyapunov_max")[i]),
        map_of(fine, "lyapunov_max_error")[i] + map_of(all_short, "lyapunov_max_error")[i] + 1e-8)
        << omega;
  }
  EXPECT_GT(same, 20U);
  EXPECT_GT(with_turns, 2U);
}

// What does not stop takes the steps of the run, so its bits are the same.
TEST(OrbitSteps, ChangeNothingOfPointsThatGoOn) {
  const SweepResult plain = run(kImpacting), fine = run(kImpacting, {"integrate.orbit_steps=4"});
  std::size_t going_on = 0;
  for (std::size_t i = 0; i < plain.status.size(); ++i) {
    if (plain.on_orbit[i] == 1 || fine.on_orbit[i] == 1) continue;
    ++going_on;
    EXPECT_EQ(map_of(plain, "x1_rms")[i], map_of(fine, "x1_rms")[i]);
    EXPECT_EQ(map_of(plain, "lyapunov_max")[i], map_of(fine, "lyapunov_max")[i]);
  }
  EXPECT_GT(going_on, 0U);
}

// The trace of a point is the motion that its map has.
TEST(OrbitSteps, AreThoseOfATraceToo) {
  const std::string point =
      replaced(kImpacting, "from = 0.5\nto = 1.1\ncount = 40", "values = [0.6]");
  const SweepResult map = run(point, {"integrate.orbit_steps=8"});
  ASSERT_EQ(map.on_orbit[0], 1);
  const auto rows = [&](const std::string& parts) {
    const Study study = read_study(point, "study", {"integrate.orbit_steps=" + parts});
    return run_trace(study, 0, {})->tau.size();
  };
  EXPECT_GT(rows("8"), 7 * rows("1"));
}

TEST(OrbitSteps, AreRefusedWhereAttractorsAreToldApart) {
  try {
    run(replaced(kImpacting, "'period'", "'period', 'attractor'"), {"integrate.orbit_steps=4"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("orbit_steps"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("attractor"));
  }
}

}  // namespace
}  // namespace gearsweep::testing
