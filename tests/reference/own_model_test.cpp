// Both engines on models of a user's own: what is said of a motion does not depend on the units of
// its states, and its exponents have errors that can be relied upon.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/run.hpp"
#include "sweep_types.h"

namespace gearsweep::testing {
namespace {

using ::testing::DoubleNear;
using ::testing::Each;
using ::testing::IsEmpty;

const std::vector<std::string> kEngines = {"opencl", "reference"};

std::string study_of(const std::string& model, const std::string& rest) {
  return "[model]\ntext = '''\n" + model + "'''\n" + rest;
}

SweepResult run_with(const std::string& engine, const std::string& study,
                     std::vector<std::string> overrides = {}) {
  overrides.push_back("integrate.engine='" + engine + "'");
  return run(study, overrides);
}

// An oscillator between two wells, whose lengths are in some unit, beside a state that is driven
// and of the size 6 in any unit. Another program, of steps of a 400th, has the periods 1, 2, none
// up to 32, and 5.
const std::string kWells = R"toml(
[model]
name = "wells"
max_step = 0.05
[states]
u = {}
v = {}
x = { start = "unit" }
[parameters]
g = 0.2
unit = 1.0
[equations]
u = "-u + 10*cos(phase)"
v = "-0.3*v + x - x^3/unit^2 + unit*(g*cos(phase) + 1e-4*u)"
x = "v"
[forcing]
period = "2*pi/1.2"
)toml";

TEST(OwnModel, HasThePeriodsOfAnyUnits) {
  const std::string study =
      study_of(kWells,
               "[[axes]]\nname = 'g'\nvalues = [0.2, 0.28, 0.3, 0.37]\n"
               "[[axes]]\nname = 'unit'\nvalues = [1e-9, 1e-6, 1.0, 1e9]\n"
               "[integrate]\nsettle = 500\nrecord = 200\nmax_step = 0.05\n"
               "[observe]\nquantities = ['period', 'motion_class', 'x_rms']\n");
  for (const std::string& engine : kEngines) {
    SCOPED_TRACE(engine);
    const SweepResult result = run_with(engine, study);
    for (std::size_t row = 0; row < 4; ++row) {
      const auto at = [&](const std::string& map) {
        const auto first = map_of(result, map).begin() + static_cast<std::ptrdiff_t>(4 * row);
        return std::vector<double>(first, first + 4);
      };
      EXPECT_EQ(at("period"), (std::vector<double>{1.0, 2.0, 0.0, 5.0})) << row;
      EXPECT_EQ(at("motion_class"), (std::vector<double>{1.0, 1.0, 3.0, 1.0})) << row;
    }
  }
}

// On a circle that turns with its forcing, th - phase is carried round, and what it varies by is
// all that a perturbation grows by: the exponent is 0. Near 1.5 it rests for long in one place, and
// then goes quickly round. (Whether the motion is a cycle of some period or none depends on w0.)
TEST(OwnModel, KnowsTheErrorOfAnExponentThatIsZero) {
  const std::string circle = R"toml(
[model]
name = "circle"
[states]
th = { angle = true }
[parameters]
w0 = 1.6
[equations]
th = "w0 + 0.5*sin(th - phase)"
[forcing]
period = "2*pi"
)toml";
  const std::string study = study_of(
      circle,
      "[[axes]]\nname = 'w0'\nfrom = 1.5012\nto = 1.8\ncount = 120\n[integrate]\nsettle = 200\n"
      "record = 200\nmax_step = 0.05\n[observe]\nquantities = ['motion_class', 'lyapunov_max', "
      "'lyapunov_max_error']\n");
  for (const std::string extend : {"1", "16"}) {
    const SweepResult result = run(study, {"integrate.extend=" + extend});
    std::vector<double> chaotic;
    for (std::size_t i = 0; i < result.status.size(); ++i) {
      const double w0 = result.study.axes[0].values[i];
      if (map_of(result, "motion_class")[i] == double{MOTION_chaotic}) chaotic.push_back(w0);
      EXPECT_LE(std::abs(map_of(result, "lyapunov_max")[i]),
                3.0 * map_of(result, "lyapunov_max_error")[i] + 1e-9)
          << w0;
    }
    EXPECT_THAT(chaotic, IsEmpty()) << extend;
  }
}

// A pressure in Pa, far from 0, and a signal that has no value.
const std::string kPressure = R"toml(
[model]
name = "vessel"
[states]
p = { unit = "Pa", start = "p0" }
[parameters]
p0 = 1e7
[equations]
p = "p0*(1 + 0.1*cos(phase)) - p"
[forcing]
period = "2*pi"
[signals]
clearance = "1/max(p - 2*p0, 0)"
)toml";

TEST(OwnModel, MayHaveLargeStates) {
  const std::string study = study_of(
      kPressure,
      "[[axes]]\nname = 'p0'\nvalues = [1e5, 1e7, 1e12]\n[integrate]\nsettle = 50\n"
      "record = 10\nmax_step = 0.05\n[observe]\nquantities = ['p_mean', 'clearance_max']\n");
  for (const std::string& engine : kEngines) {
    SCOPED_TRACE(engine);
    const SweepResult result = run_with(engine, study);
    EXPECT_THAT(result.status, Each(STATUS_ok));
    for (std::size_t i = 0; i < 3; ++i) {
      const double p0 = result.study.axes[0].values[i];
      EXPECT_NEAR(map_of(result, "p_mean")[i] / p0, 1.0, 1e-9);
    }
    EXPECT_THAT(map_of(result, "clearance_max"), Each(INFINITY));
    const SweepResult bounded =
        run_with(engine, study, {"axes.p0.values=[1e5, 1e7]", "integrate.diverged_above=1e6"});
    EXPECT_EQ(bounded.status, (std::vector<std::uint8_t>{STATUS_ok, STATUS_diverged}));
  }
}

// It decays by exp(-840) in a period, which is no number of its own. Steps of 0.02 leave 0.008.
TEST(OwnModel, HasTheExponentOfWhatVanishesWithinAPeriod) {
  const std::string decay =
      "[model]\nname = 'decay'\n[states]\nx = { start = '1' }\n[parameters]\nrate = 21.0\n"
      "[equations]\nx = '-rate*x'\n[forcing]\nperiod = '40'\n";
  const std::string study =
      study_of(decay,
               "[[axes]]\nname = 'rate'\nvalues = [21.0]\n[integrate]\nsettle = 2\nrecord = 4\n"
               "max_step = 0.02\nstop = 'never'\n[observe]\nquantities = ['lyapunov_max']\n");
  for (const std::string& engine : kEngines) {
    EXPECT_THAT(map_of(run_with(engine, study), "lyapunov_max"), Each(DoubleNear(-21.0, 0.01)))
        << engine;
  }
}

// In so short a record no vector finds its direction: the second one decays less than the first.
TEST(OwnModel, HasItsLargestExponentFirst) {
  const std::string nodes =
      "[model]\nname = 'nodes'\n[states]\na = { start = '1' }\nb = { start = '1' }\n[parameters]\n"
      "rate = 3.0\n[equations]\na = '-a'\nb = '-rate*b'\n[forcing]\nperiod = '0.1'\n";
  const std::string study = study_of(
      nodes,
      "[[axes]]\nname = 'rate'\nvalues = [3.0, 5.0]\n[integrate]\nsettle = 0\nrecord = 2\n"
      "warm_up = 0\nmax_step = 0.02\nstop = 'never'\n[observe]\nquantities = ['lyapunov_max', "
      "'lyapunov_max_error', 'lyapunov_max_per_period', 'lyapunov_spectrum']\n");
  for (const std::string& engine : kEngines) {
    SCOPED_TRACE(engine);
    const SweepResult result = run_with(engine, study);
    const std::vector<double>& spectrum = map_of(result, "lyapunov_spectrum");
    for (std::size_t i = 0; i < 2; ++i) {
      const double largest = map_of(result, "lyapunov_max")[i];
      EXPECT_GT(spectrum[2 * i], spectrum[2 * i + 1]);
      EXPECT_EQ(largest, spectrum[2 * i]);
      EXPECT_NEAR(map_of(result, "lyapunov_max_per_period")[i], 0.1 * largest, 1e-12);
      EXPECT_GE(map_of(result, "lyapunov_max_error")[i], largest - spectrum[2 * i + 1]);
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
