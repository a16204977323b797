// The error that is told of the exponents of periodic motion is more than the true one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// x'' + c x' + s x = F cos(omega t) decays by c/2 wherever it oscillates, whatever the step.
TEST(ExponentError, HoldsForLinearOscillatorsAtAnyStep) {
  for (const char* steps : {"16", "24", "48", "128"}) {
    for (const char* stop : {"orbit", "never"}) {
      SCOPED_TRACE(std::string(steps) + ", " + stop);
      const SweepResult result = run(
          "[model]\nname = 'duffing'\n[parameters]\ndamping = 0.1\ncubic = 0.0\namplitude = 0.7\n"
          "omega = 1.3\n[[axes]]\nname = 'linear'\nfrom = 0.5\nto = 4.0\ncount = 20\n"
          "[integrate]\nsettle = 500\n[observe]\n"
          "quantities = ['lyapunov_max', 'lyapunov_max_error']\n",
          {std::string("integrate.steps_per_period=") + steps,
           std::string("integrate.stop=") + stop});
      for (std::size_t point = 0; point < result.status.size(); ++point) {
        // 1e-12: rounding of a few hundred steps. Where both multipliers nearly coincide, their
        // distance goes as the root of what the steps leave, and that need not grow with them.
        EXPECT_LE(std::abs(map_of(result, "lyapunov_max")[point] + 0.05),
                  2.0 * map_of(result, "lyapunov_max_error")[point] + 1e-12)
            << point;
      }
    }
  }
}

// Orbits with impacts, against exponents at an eighth of the step and what those are told to be off
// by. Where a flank is grazed the order of the steps does not show: one point of a hundred may be
// beyond.
TEST(ExponentError, HoldsForOrbitsWithImpacts) {
  const std::string gear =
      "[model]\npreset = 'coarse'\n[parameters]\nb = 1.0\n[[axes]]\nname = 'omega'\n"
      "from = 0.5\nto = 1.1\ncount = 60\n[observe]\n"
      "quantities = ['lyapunov_max', 'lyapunov_max_error', 'period', 'x1_rms']\n";
  const SweepResult finer = run(gear, {"integrate.max_step=0.00625"});
  for (const char* stop : {"orbit", "never"}) {
    SCOPED_TRACE(stop);
    const SweepResult result = run(gear, {std::string("integrate.stop=") + stop});
    std::size_t compared = 0, beyond = 0;
    for (std::size_t point = 0; point < result.status.size(); ++point) {
      const double period = map_of(result, "period")[point];
      if (period == 0.0 || period > 16.0 || period != map_of(finer, "period")[point]) continue;
      // Another attractor of the same period.
      if (std::abs(map_of(result, "x1_rms")[point] - map_of(finer, "x1_rms")[point]) > 1e-3) {
        continue;
      }
      ++compared;
      const double off =
          std::abs(map_of(result, "lyapunov_max")[point] - map_of(finer, "lyapunov_max")[point]);
      if (off > map_of(result, "lyapunov_max_error")[point] +
                    map_of(finer, "lyapunov_max_error")[point]) {
        ++beyond;
      }
    }
    EXPECT_GT(compared, 30U);
    EXPECT_LE(beyond, 1U);
  }
}

}  // namespace
}  // namespace gearsweep::testing
