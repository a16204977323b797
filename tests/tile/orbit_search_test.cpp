// Points that stop on a periodic orbit: what is found, what is said of it, and that nothing else
// changes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "support/bits.hpp"
#include "support/run.hpp"
#include "tile/detail/orbit_newton.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Each;
using ::testing::Lt;

const NewtonLimits kLimits = {1e-7, 1e-4, 0.5, 1e-10};

// The map x -> A x + b in two dimensions.
struct AffineMap {
  std::vector<double> columns;  // of A
  std::vector<double> b;
  std::vector<double> operator()(const std::vector<double>& x) const {
    return {columns[0] * x[0] + columns[2] * x[1] + b[0],
            columns[1] * x[0] + columns[3] * x[1] + b[1]};
  }
};

// States are of the size of 1.
NewtonTry on_map() {
  NewtonTry one;
  one.ranges = {1.0, 1.0};
  return one;
}

NewtonVerdict step(const AffineMap& map, NewtonTry* one, const NewtonLimits& limits = kLimits) {
  const std::vector<double> mapped = map(one->state);
  return newton_step(mapped, map.columns, limits, 2, one);
}

NewtonVerdict confirm(const AffineMap& map, NewtonTry* one) {
  const std::vector<double> mapped = map(one->state);
  return newton_confirm(mapped, map.columns, kLimits, one);
}

// (I - A)^-1 b = (1, 2), so one step from anywhere is enough, and the next one sees it.
TEST(NewtonStep, FindsTheFixedPointOfAnAffineMapAtOnce) {
  const AffineMap map = {{0.5, 0.0, 0.0, -0.25}, {0.5, 2.5}};
  NewtonTry one = on_map();
  one.start = one.state = {1.1, 2.2};
  EXPECT_EQ(step(map, &one), NewtonVerdict::going_on);
  EXPECT_EQ(step(map, &one), NewtonVerdict::close);
  EXPECT_EQ(confirm(map, &one), NewtonVerdict::found);
  EXPECT_DOUBLE_EQ(one.state[0], 1.0);
  EXPECT_DOUBLE_EQ(one.state[1], 2.0);
  EXPECT_DOUBLE_EQ(one.log_multipliers[0], std::log(0.5));
  EXPECT_DOUBLE_EQ(one.log_multipliers[1], std::log(0.25));
}

// What looked like the orbit may lie beyond a kink, where the derivative is another.
TEST(NewtonStep, DoesNotTakeForAnOrbitWhatDoesNotComeBack) {
  const AffineMap map = {{0.5, 0.0, 0.0, -0.25}, {0.5, 2.5}};
  const AffineMap beyond = {map.columns, {0.5, 2.5 + 1e-5}};
  NewtonTry one = on_map();
  one.start = one.state = {1.00001, 2.0};
  EXPECT_EQ(step(map, &one), NewtonVerdict::close);
  EXPECT_EQ(confirm(beyond, &one), NewtonVerdict::going_on);
  // It has gone on to where that map would stay.
  EXPECT_EQ(confirm(beyond, &one), NewtonVerdict::found);
  EXPECT_NEAR(one.state[1], 2.0 + 0.8e-5, 1e-15);
}

TEST(NewtonStep, LeavesAnUnstableFixedPointAlone) {
  const AffineMap map = {{1.5, 0.0, 0.0, 0.5}, {-0.5, 1.0}};
  NewtonTry one = on_map();
  one.start = one.state = {1.0, 2.0};
  EXPECT_EQ(step(map, &one), NewtonVerdict::unstable);
}

TEST(NewtonStep, GoesNoFartherThanItMay) {
  const AffineMap map = {{0.99, 0.0, 0.0, 0.5}, {0.01, 1.0}};
  NewtonTry one = on_map();
  one.start = one.state = {5.0, 2.0};  // it is nearly back, and yet far from (1, 2)
  EXPECT_EQ(step(map, &one), NewtonVerdict::failed);
}

TEST(NewtonStep, DoesNotReadMultipliersOutOfRounding) {
  const AffineMap map = {{0.5, 0.0, 0.0, 1e-12}, {0.5, 2.0}};
  NewtonTry one = on_map();
  one.start = one.state = {1.0, 2.0};
  EXPECT_EQ(step(map, &one), NewtonVerdict::failed);
}

// x -> x/2 + 1/2 + (x - 1)^2 has the fixed point 1 and the multiplier 1/2 there.
double bent(double x) { return 0.5 * x + 0.5 + (x - 1.0) * (x - 1.0); }

NewtonTry beside_bent(double x) {
  NewtonTry one;
  one.ranges = {1.0};
  one.start = one.state = {x};
  return one;
}

NewtonVerdict step_on_bent(NewtonTry* one, double kept, std::vector<double>* derivative) {
  NewtonLimits limits = kLimits;
  limits.kept = kept;
  *derivative = {0.5 + 2.0 * (one->state[0] - 1.0)};
  return newton_step(std::vector{bent(one->state[0])}, *derivative, limits, 1, one);
}

// With the derivative that was taken beside the orbit each turn brings it nearer, to where the map
// stays.
TEST(NewtonStep, MayKeepTheDerivativeBesideAnOrbit) {
  std::vector<double> derivative;
  NewtonTry one = beside_bent(1.01);
  NewtonLimits limits = kLimits;
  limits.kept = 3e-2;
  ASSERT_EQ(step_on_bent(&one, limits.kept, &derivative), NewtonVerdict::close);
  EXPECT_DOUBLE_EQ(one.log_multipliers[0], std::log(0.52));
  int turns = 1;
  for (NewtonVerdict verdict = NewtonVerdict::close; verdict != NewtonVerdict::found; ++turns) {
    ASSERT_LT(turns, 6);
    verdict = newton_confirm(std::vector{bent(one.state[0])}, derivative, limits, &one);
    ASSERT_NE(verdict, NewtonVerdict::going_on);
  }
  EXPECT_NEAR(one.state[0], 1.0, 1e-8);
  // Who wants the multipliers themselves knows how far away they were taken.
  EXPECT_NEAR(one.step, 0.01, 1e-3);
}

TEST(NewtonStep, TakesAnotherDerivativeWhereItMayNotKeepOne) {
  std::vector<double> derivative;
  NewtonTry unasked = beside_bent(1.01);
  EXPECT_EQ(step_on_bent(&unasked, 0.0, &derivative), NewtonVerdict::going_on);
  NewtonTry far = beside_bent(1.1);
  EXPECT_EQ(step_on_bent(&far, 3e-2, &derivative), NewtonVerdict::going_on);
}

// What was seen beside the orbit says 0.985; at the orbit it could as well be 0.99.
TEST(NewtonStep, TakesAnotherDerivativeWhereStabilityIsClose) {
  NewtonLimits limits = kLimits;
  limits.kept = 3e-2;
  NewtonTry one = beside_bent(1.005);
  const double mapped = 1.0 + 0.98 * 0.005;
  EXPECT_EQ(newton_step(std::vector{mapped}, std::vector{0.985}, limits, 1, &one),
            NewtonVerdict::going_on);
}

const std::string kOscillator =
    "[model]\nname = 'duffing'\n[parameters]\ndamping = 0.05\nlinear = 2.0\ncubic = 0.0\n"
    "amplitude = 0.7\n[[axes]]\nname = 'omega'\nvalues = [1.3]\n"
    "[integrate]\nsteps_per_period = 512\n";

// A linear oscillator x'' + c x' + linear x = F cos(omega t) has one orbit, of known size, and both
// exponents are -c/2 (it oscillates while it decays).
TEST(OrbitSearch, KnowsTheOrbitOfALinearOscillator) {
  const double damping = 0.05, linear = 2.0, amplitude = 0.7, omega = 1.3;
  const SweepResult result =
      run(kOscillator +
          "[observe]\nquantities = ['x_rms', 'period', 'settled', 'lyapunov_spectrum', "
          "'lyapunov_max_error', 'motion_class']\n");
  EXPECT_EQ(result.stopped, 1U);
  const std::complex<double> stiffness(linear - omega * omega, damping * omega);
  // The steps leave (2 pi / 512)^4 / 120 = 2e-10 in each period, and damping keeps some 10 of them.
  EXPECT_NEAR(map_of(result, "x_rms")[0], amplitude / std::abs(stiffness) / std::numbers::sqrt2,
              1e-8);
  for (const double exponent : map_of(result, "lyapunov_spectrum")) {
    EXPECT_NEAR(exponent, -damping / 2.0, 1e-8);
  }
  EXPECT_LE(std::abs(map_of(result, "lyapunov_spectrum")[0] + damping / 2.0),
            map_of(result, "lyapunov_max_error")[0]);
  EXPECT_LT(map_of(result, "lyapunov_max_error")[0], 1e-6);
  EXPECT_EQ(map_of(result, "period")[0], 1.0);
  EXPECT_EQ(map_of(result, "motion_class")[0], 1.0);
  EXPECT_LT(map_of(result, "settled")[0], 150.0);
}

// The return map of a linear oscillator is affine: extrapolated, the last returns give the orbit
// itself, and one derivative is enough, in one run of the map with it and one without. The returns
// that were extrapolated are seen to converge to it, and the orbit is recorded and repeated.
TEST(OrbitSearch, TakesOneDerivativeWhereTheMapIsAffine) {
  const SweepResult result = run(kOscillator + "[observe]\nquantities = ['settled']\n");
  EXPECT_EQ(result.stopped, 1U);
  const double settled = map_of(result, "settled")[0];
  const double with_derivative = 8.0, without = 1.0, recorded = 1.0, repeated = 1.0;
  EXPECT_EQ(result.steps, 512.0 * (settled + with_derivative + without + recorded + repeated));
}

const std::string kGear =
    "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.5\nto = 1.9\ncount = 15\n"
    "[[axes]]\nname = 'b'\nvalues = [0.7, 1.0]\n[integrate]\nsettle = 4000\nrecord = 120\n"
    "[observe]\nquantities = ['x1_rms', 'x1_max', 'dmf_max', 'contact_drive', 'period', "
    "'lyapunov_max', 'poincare']\npoincare = ['x1', 'v3']\n";

// Periods 1, 2 and others that divide 120, and chaos. After 4,000 periods every orbit that is found
// is reached to 1e-6 by plain settling, too.
TEST(OrbitSearch, SaysWhatARunToTheEndSays) {
  const SweepResult stopped = run(kGear);
  const SweepResult whole = run(kGear, {"integrate.stop=never"});
  EXPECT_EQ(whole.stopped, 0U);
  std::size_t same_bits_points = 0, periodic = 0;
  for (std::size_t point = 0; point < whole.status.size(); ++point) {
    SCOPED_TRACE(point);
    const double period = map_of(whole, "period")[point];
    EXPECT_EQ(map_of(stopped, "period")[point], period);
    const double margin = period > 0.0 ? 1e-5 : 0.0;  // chaos goes on untouched
    for (const char* name : {"x1_rms", "x1_max", "dmf_max", "contact_drive"}) {
      EXPECT_NEAR(map_of(stopped, name)[point], map_of(whole, name)[point], margin) << name;
    }
    for (std::size_t chosen = 0; chosen < 2; ++chosen) {
      const std::vector<double> a = samples_of(stopped, point, chosen);
      const std::vector<double> b = samples_of(whole, point, chosen);
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], margin);
    }
    // 120 periods leave a turn or less of what oscillates.
    EXPECT_NEAR(map_of(stopped, "lyapunov_max")[point], map_of(whole, "lyapunov_max")[point],
                period > 0.0 ? 2.0 / (120.0 * 2.0 * std::numbers::pi / 1.9) : 0.0);
    ++(period > 0.0 ? periodic : same_bits_points);
  }
  EXPECT_GT(periodic, 10U);
  EXPECT_GT(same_bits_points, 4U);
  EXPECT_GT(stopped.stopped, 10U);
  EXPECT_LT(stopped.steps, 0.7 * whole.steps);
}

TEST(OrbitSearch, IsTheSameForAnyCut) {
  const std::vector<std::string> shorter = {"integrate.settle=220", "integrate.record=12"};
  const SweepResult expected = run(kGear, shorter);
  EXPECT_GT(expected.stopped, 5U);
  for (const char* cut : {"integrate.lanes=1", "integrate.lanes=4", "integrate.tile=7",
                          "integrate.round=3", "integrate.local_size=1"}) {
    SCOPED_TRACE(cut);
    std::vector<std::string> overrides = shorter;
    overrides.emplace_back(cut);
    const SweepResult result = run(kGear, overrides);
    EXPECT_EQ(result.stopped, expected.stopped);
    for (std::size_t i = 0; i < result.values.size(); ++i) {
      // Logarithms of the scalar device may differ in the last bit.
      if (result.study.selection.quantities[i].name == "lyapunov_max") continue;
      EXPECT_EQ(different_bits(result.values[i], expected.values[i]), 0U)
          << result.study.selection.quantities[i].name;
    }
    EXPECT_EQ(different_bits(result.samples, expected.samples), 0U);
  }
}

// At rest on the ridge between two wells the state recurs, but the orbit is not stable.
TEST(OrbitSearch, DoesNotStopOnAnUnstableOrbit) {
  const SweepResult result =
      run("[model]\nname = 'duffing'\npreset = 'two_well'\n[parameters]\namplitude = 0\n"
          "[[axes]]\nname = 'omega'\nvalues = [1.0]\n[observe]\nquantities = ['x_rms']\n");
  EXPECT_EQ(result.stopped, 0U);
}

TEST(OrbitSearch, KeepsDivergedPointsApart) {
  const SweepResult result =
      run("[model]\nname = 'duffing'\n[parameters]\ndamping = 0.1\ncubic = 0.0\n"
          "amplitude = 0.3\n[[axes]]\nname = 'linear'\nvalues = [-1.0, 1.0]\n"
          "[observe]\nquantities = ['x_rms']\n");
  EXPECT_EQ(result.status, (std::vector<std::uint8_t>{1, 0}));
  EXPECT_TRUE(std::isnan(map_of(result, "x_rms")[0]));
  EXPECT_EQ(result.stopped, 1U);
}

}  // namespace
}  // namespace gearsweep::testing
