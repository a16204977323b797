// Monodromy matrices, multipliers and shooting, against closed forms and the kernel.
#include "orbits/floquet.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "model/error.hpp"
#include "orbits/example_orbits.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

// Meissner's closed form: trace and determinant over one period of the square wave.
struct Meissner {
  double trace, determinant;

  explicit Meissner(double omega) {
    const double T = 2.0 * std::numbers::pi / omega;
    const double z = 0.05;
    const double w1 = std::sqrt(0.7 - z * z), w2 = std::sqrt(1.3 - z * z);
    const double a = w1 * 0.4 * T, b = w2 * 0.6 * T;
    trace = std::exp(-z * T) *
            (2.0 * std::cos(a) * std::cos(b) - (w1 / w2 + w2 / w1) * std::sin(a) * std::sin(b));
    determinant = std::exp(-2.0 * z * T);
  }
};

// The steps' error is (w h)^4 T / 120, less than 1e-11 with 4096 steps at these frequencies.
TEST(Floquet, SquareWaveStiffnessHasMeissnersMonodromy) {
  for (const double omega : {1.3, 1.7, 2.4, 3.1}) {
    const Orbit orbit = meissner(omega).orbit(400, 4096);
    const Meissner exact(omega);
    EXPECT_EQ(orbit.period, 1U);
    EXPECT_NEAR(orbit.monodromy.trace(), exact.trace, 1e-9) << omega;
    EXPECT_NEAR(orbit.monodromy.determinant(), exact.determinant, 1e-9) << omega;
    EXPECT_NEAR(std::abs(orbit.multipliers.sum() - exact.trace), 0.0, 1e-9) << omega;
    EXPECT_NEAR(std::abs(orbit.multipliers.prod() - exact.determinant), 0.0, 1e-9) << omega;
  }
}

// In the tongue at omega = 2 the orbit in contact is unstable, and the shooting is started on it,
// not led there by the motion.
TEST(Floquet, AnUnstableOrbitIsFoundAllTheSame) {
  const Example example = meissner(1.97);
  const std::vector<double> rest = example.model->equilibrium(example.setting);
  const std::optional<Orbit> orbit =
      shoot(example.map(4096), Eigen::Map<const Eigen::VectorXd>(rest.data(), 2), 1);
  ASSERT_TRUE(orbit.has_value());
  EXPECT_EQ(orbit->unstable_count(), 1U);
  EXPECT_NEAR(orbit->monodromy.trace(), Meissner(1.97).trace, 1e-9);
  EXPECT_EQ(nearest_bifurcation(*orbit)->kind, Bifurcation::flip);
}

// Liouville: the multipliers' product is the exponential of the field's divergence over the orbit,
// -0.49771584 T for the preset's damping (the exact Lyapunov sum, 8 digits: 5e-9 T relative), with
// impacts, friction and both backlash laws.
TEST(Floquet, ProductOfGear5sMultipliersIsTheExactSum) {
  for (const char* backlash : {"constant", "dynamic"}) {
    const Example example("gear5", {{"omega", 0.65}, {"e0", 0.6}}, {{"backlash", backlash}});
    const Orbit orbit = example.orbit(400);
    const double T = static_cast<double>(orbit.period) * 2.0 * std::numbers::pi / 0.65;
    EXPECT_NEAR(std::log(orbit.monodromy.determinant()) / T, -0.49771584, 1e-8) << backlash;
    EXPECT_NEAR(std::log(std::abs(orbit.multipliers.prod())) / T, -0.49771584, 1e-8) << backlash;
  }
}

// Central differences of 1e-6 leave 1e-12 of curvature and 1e-9 of rounding.
TEST(Floquet, MonodromyIsTheDerivativeOfTheMap) {
  const Example example("gear5", {{"omega", 0.7}, {"e0", 0.5}}, {{"backlash", "dynamic"}});
  const PeriodMap map = example.map();
  const Orbit orbit = example.orbit(400);
  for (Eigen::Index i = 0; i < 10; ++i) {
    const Eigen::VectorXd shift = 1e-6 * Eigen::VectorXd::Unit(10, i);
    const Eigen::VectorXd slope = (map.advance(orbit.state + shift, 1).value() -
                                   map.advance(orbit.state - shift, 1).value()) /
                                  2e-6;
    EXPECT_LT((slope - orbit.monodromy.col(i)).cwiseAbs().maxCoeff(), 1e-8) << i;
  }
}

// Reference orbits of two independent programs, printed to 7 digits.
TEST(Floquet, ShootingGivesTheReferenceOrbits) {
  const Orbit half = Example("gear5", {{"omega", 0.5}}).orbit(200, 4096);
  EXPECT_NEAR(half.state[0], 0.7177006, 1e-7);
  EXPECT_NEAR(half.state[5], -0.2098154, 1e-7);
  const Orbit three = Example("gear5", {{"omega", 1.2}}).orbit(400, 4096);
  EXPECT_EQ(three.period, 3U);
  const PeriodMap map = Example("gear5", {{"omega", 1.2}}).map(4096);
  double nearest = 1.0;  // the table gives one of the orbit's three states
  for (std::size_t i = 0; i < 3; ++i) {
    nearest = std::min(nearest, std::fabs(map.advance(three.state, i).value()[0] - 1.5159069));
  }
  EXPECT_LT(nearest, 1e-7);
}

// On a periodic orbit the exponents are ln|multiplier| / T. The kernel averages over 1000 periods:
// what is bounded by 1 in the logarithms is 1/(1000 T) = 1.1e-4 there. The long
// warm-up leaves the tangent vectors time to turn where neighbouring exponents differ by 0.01.
TEST(Floquet, MultipliersAreTheKernelsLyapunovSpectrum) {
  const SweepResult result =
      run("[model]\nname = 'gear5'\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nvalues = [0.7]\n"
          "[integrate]\nsteps_per_period = 512\nrecord = 1000\nsettle = 2000\nwarm_up = 1500\n"
          "[observe]\nquantities = ['lyapunov_spectrum']\n");
  const std::vector<double>& exponents = map_of(result, "lyapunov_spectrum");
  const Orbit orbit = Example("gear5", {{"omega", 0.7}, {"e0", 0.6}}).orbit(400, 512);
  ASSERT_EQ(exponents.size(), 10U);
  for (Eigen::Index i = 0; i < 10; ++i) {
    const double T = 2.0 * std::numbers::pi / 0.7;
    EXPECT_NEAR(exponents[static_cast<std::size_t>(i)],
                std::log(std::abs(orbit.multipliers[i])) / T, 1.2e-4)
        << i;
  }
}

TEST(Floquet, TheLeastPeriodIsReported) {
  const Example example("pendulum", {{"damping", 0.745},
                                     {"drive", 1.5},
                                     {"omega", 2.0 / 3.0},
                                     {"phase", std::numbers::pi / 2.0}});
  EXPECT_EQ(example.orbit(300).period, 1U);
  const Eigen::VectorXd settled = example.orbit(300).state;
  EXPECT_THROW(find_orbit(example.map(), settled, 2), RunError);
}

TEST(Floquet, ChaosIsRefusedUnlessAPeriodIsGiven) {
  const Example example("duffing", {{"damping", 0.25}, {"linear", -1.0}, {"amplitude", 0.4}});
  const PeriodMap map = example.map();
  const Eigen::VectorXd wandering = map.advance(Eigen::Vector2d(0.2, 0.0), 200).value();
  EXPECT_THROW(find_orbit(map, wandering, std::nullopt), RunError);
  const Orbit inside = find_orbit(map, wandering, 1);
  EXPECT_EQ(inside.period, 1U);
  EXPECT_FALSE(inside.stable());
  // Newton's method stops at 1e-12, and the orbit's stretching is about ten.
  EXPECT_LT((map.advance(inside.state, 1).value() - inside.state).norm(), 1e-11);
}

TEST(Floquet, OnlyDrivenModelsHaveAPeriod) {
  EXPECT_TRUE(Example("pendulum", {}).map().driven());
  EXPECT_TRUE(Example("gear5", {}).map().driven());
  EXPECT_FALSE(Example("lorenz", {}).map().driven());
}

}  // namespace
}  // namespace gearsweep::testing
