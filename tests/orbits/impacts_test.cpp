// Orbits with impacts: multipliers against closed forms and an outside integration, the order at
// which they converge, and what is said of their errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "orbits/exact_impacts.hpp"
#include "orbits/orbit_error.hpp"
#include "study/model_file.hpp"
#include "support/eigenvalues.hpp"

namespace gearsweep::testing {
namespace {

// The largest distance of two orbits' multipliers, each to the nearest.
double apart(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  double most = 0.0;
  for (const std::complex<double>& one : a) {
    most = std::max(most, (b.array() - one).abs().minCoeff());
  }
  return most;
}

Orbit shot(const Example& example, std::size_t steps, const Orbit& near) {
  return shoot(example.map(steps), near.state, near.period).value();
}

// Eight digits of an independent integrator of order 8 that locates the impacts.
TEST(Impacts, MultipliersOfGear5AreThoseOfAnOutsideIntegration) {
  const Example example("gear5", {{"omega", 0.55}, {"e0", 0.6}});
  Eigen::VectorXd near(10);
  near << 0.5419, 0.0002, -0.1870, -0.0002, 0.1870, -0.5034, 0.0026, -0.2401, -0.0026, 0.2401;
  const std::complex<double> first = shoot(example.map(2048), near, 1).value().multipliers[0];
  EXPECT_NEAR(first.real(), -0.10191766, 1e-8);
  EXPECT_NEAR(std::fabs(first.imag()), 1.07545673, 1e-8);
}

struct ExactCase {
  double w, Fte;
  int impacts;
};

// Without impacts, with one flank and with both. A step h has the error (w h)^4 T/120 = 8e-11 at
// the longest period, and impacts are located to rounding.
TEST(Impacts, OrbitsAndMultipliersAreTheExactOnes) {
  for (const ExactCase& one : {ExactCase{0.8, 0.02, 0}, ExactCase{0.8, 0.1, 2},
                               ExactCase{0.7, 0.2, 2}, ExactCase{0.7, 0.5, 4}}) {
    const ImpactOscillator oscillator = {.Fte = one.Fte, .w = one.w};
    const Example example = oscillator.example();
    const Orbit orbit = shot(example, 2048, example.orbit(400, 128));
    const ImpactOscillator::Image exact = oscillator.orbit(orbit.state);
    ASSERT_EQ(exact.impacts, one.impacts);
    EXPECT_LT((orbit.state - exact.state).norm(), 1e-10) << one.w << ' ' << one.Fte;
    EXPECT_LT(apart(orbit.multipliers, eigenvalues_of(exact.monodromy)), 1e-10)
        << one.w << ' ' << one.Fte;
  }
}

// The mean order over three halvings from 128 steps on; where an impact lies within its step
// changes the single ones. 4096 steps leave 1e-6 of the error at 128.
TEST(Impacts, MultipliersConvergeWithTheFourthOrder) {
  for (const Example& example :
       {Example("gear5", {{"omega", 0.65}, {"e0", 0.6}}),
        Example("gear5", {{"omega", 0.65}, {"e0", 0.6}}, {{"backlash", "dynamic"}}),
        // Wedged for a part of the period.
        Example("gear5", {{"omega", 0.5021}, {"e0", 0.6}, {"b", 0.2553}},
                {{"backlash", "dynamic"}}),
        Example("gear5", {{"omega", 1.0}, {"e0", 0.6}}, {{"stiffness", "rectangular"}}),
        Example("gear1", {{"omega", 1.0}, {"Fte", 0.1}})}) {
    const Orbit near = example.orbit(400, 128);
    const Eigen::VectorXcd truth = shot(example, 4096, near).multipliers;
    const double coarse = apart(shot(example, 128, near).multipliers, truth);
    const double fine = apart(shot(example, 1024, near).multipliers, truth);
    EXPECT_GT(std::log2(coarse / fine) / 3.0, 3.7) << coarse << " to " << fine;
    EXPECT_LT(fine, 1e-7);
  }
}

// A stop beside a wall: of a step that comes to the stop the part behind it has another Jacobian.
TEST(Impacts, MultipliersBesideAWallConvergeWithTheFourthOrder) {
  const auto model = read_model_text(R"toml([model]
name = "stop_and_wall"
[states]
x = { start = "0.3" }
v = {}
[parameters]
omega = 0.9
[equations]
x = "v"
v = "-x - 0.15*v - 20*max(x - 0.5, 0) + 1.3*cos(phase)"
[forcing]
period = "2*pi/omega"
[surfaces.wall]
when = "-x - 1.1"
reset = { v = "-0.8*v" }
)toml",
                                     "wall.toml");
  const auto shot = [&](std::size_t steps) {
    const PeriodMap map(*model, model->default_setting(), steps);
    const Eigen::VectorXd settled = map.advance(Eigen::Vector2d(0.3, 0.0), 60).value();
    return shoot(map, settled, 1).value().multipliers;
  };
  const Eigen::VectorXcd truth = shot(3200);
  const double coarse = apart(shot(100), truth), fine = apart(shot(800), truth);
  EXPECT_GT(std::log2(coarse / fine) / 3.0, 3.7) << coarse << " to " << fine;
  EXPECT_LT(fine, 1e-7);
}

// Two or three digits are lost to the crossing's own motion with the start, which is left out of
// the derivative: h^4. Central differences of 1e-6 leave 1e-9.
TEST(Impacts, MonodromyIsTheDerivativeOfTheMap) {
  const Example example("gear5", {{"omega", 0.65}, {"e0", 0.6}}, {{"backlash", "dynamic"}});
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

// Exact answers at every number of steps: the error that is told is never less than the true one,
// nor hundreds of times as much.
TEST(OrbitError, IsMoreThanTheTrueErrorAndNotMuchMore) {
  for (const ExactCase& one : {ExactCase{0.5, 0.2, 0}, ExactCase{0.8, 0.1, 2},
                               ExactCase{0.7, 0.2, 2}, ExactCase{0.7, 0.5, 4}}) {
    const ImpactOscillator oscillator = {.Fte = one.Fte, .w = one.w};
    const Example example = oscillator.example();
    const Orbit near = example.orbit(400, 128);
    const ImpactOscillator::Image exact = oscillator.orbit(near.state);
    for (const std::size_t steps : {64U, 128U, 256U, 512U, 1024U}) {
      const Orbit orbit = shot(example, steps, near);
      const OrbitError error = error_of(orbit, example.map(steps / 2));
      EXPECT_FALSE(error.grazing());
      const Eigen::VectorXd off = (orbit.state - exact.state).cwiseAbs();
      EXPECT_TRUE((off.array() < error.state.array()).all()) << steps;
      const double wrong = apart(orbit.multipliers, eigenvalues_of(exact.monodromy));
      EXPECT_LT(wrong, error.multipliers.maxCoeff()) << steps;
      EXPECT_GT(200.0 * wrong, error.multipliers.maxCoeff()) << steps;
    }
  }
}

// A motion that would touch its limit exactly, and a little more or less. Multipliers change by the
// root of that little, and whether the flanks part is up to the error of the state.
TEST(OrbitError, TellsThatAMotionGrazesALimit) {
  for (const double beyond : {-1e-4, -1e-8, -1e-10, -1e-12, 0.0, 1e-12, 1e-10, 1e-8, 1e-4}) {
    ImpactOscillator oscillator;
    oscillator.Fte *= oscillator.Fm * (1.0 + beyond) / std::abs(oscillator.swing());
    const ImpactOscillator::Image exact = oscillator.orbit(oscillator.linear_state());
    const Example example = oscillator.example();
    for (const std::size_t steps : {128U, 512U, 2048U}) {
      const Orbit orbit = shoot(example.map(steps), exact.state, 1).value();
      const OrbitError error = error_of(orbit, example.map(steps / 2));
      EXPECT_LT(apart(orbit.multipliers, eigenvalues_of(exact.monodromy)),
                error.multipliers.maxCoeff())
          << beyond << ' ' << steps;
      // At 128 steps the state has an error of 5e-7 at most, at 2048 of 1e-11.
      const bool near = std::fabs(beyond) <= 1e-10, far = std::fabs(beyond) >= 1e-4;
      EXPECT_TRUE(error.grazing() || !near) << beyond << ' ' << steps;
      EXPECT_FALSE(error.grazing() && far) << beyond << ' ' << steps;
    }
  }
}

// One step of a period that touches a limit for less than a thousandth of a step is seen all the
// same: the multipliers are the exact ones.
TEST(Impacts, ATouchShorterThanAStepIsSeen) {
  ImpactOscillator oscillator;
  oscillator.Fte *= oscillator.Fm * (1.0 + 1e-8) / std::abs(oscillator.swing());
  const ImpactOscillator::Image exact = oscillator.orbit(oscillator.linear_state());
  ASSERT_EQ(exact.impacts, 2);
  const Orbit orbit = shoot(oscillator.example().map(2048), exact.state, 1).value();
  EXPECT_LT(apart(orbit.multipliers, eigenvalues_of(exact.monodromy)), 1e-7);
}

TEST(OrbitError, IsInfiniteWhereCoarserStepsFindNoOrbit) {
  const Example example("gear5", {{"omega", 0.7}});
  const Orbit orbit = example.orbit(400);
  // Four steps to a period of nine units of time are beyond the method's stability.
  const OrbitError error = error_of(orbit, example.map(4));
  EXPECT_TRUE(std::isinf(error.state.minCoeff()));
  EXPECT_TRUE(std::isinf(error.multipliers.maxCoeff()));
}

}  // namespace
}  // namespace gearsweep::testing
