// Bifurcations located along a branch, against published points and closed forms.
#include "orbits/continuation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "orbits/example_orbits.hpp"

namespace gearsweep::testing {
namespace {

// x'' + x'/Q + sin x = 1.5 cos(2 t/3).
Example pendulum(double Q) {
  return Example("pendulum", {{"damping", 1.0 / Q},
                              {"drive", 1.5},
                              {"omega", 2.0 / 3.0},
                              {"phase", std::numbers::pi / 2.0}});
}

// x'' + 0.3 x' - x + x^3 = g cos 1.2 t.
Example duffing(double g) {
  return Example("duffing", {{"damping", 0.3},
                             {"linear", -1.0},
                             {"cubic", 1.0},
                             {"amplitude", g},
                             {"omega", 1.2},
                             {"phase", std::numbers::pi / 2.0}});
}

// The one bifurcation of a branch.
LocatedBifurcation only(const Branch& branch) {
  EXPECT_EQ(branch.bifurcations.size(), 1U) << branch.ended;
  return branch.bifurcations.empty() ? LocatedBifurcation() : branch.bifurcations.front();
}

// Follows the settled orbit of the pendulum to a greater Q; what it meets and at which Q.
std::pair<LocatedBifurcation, double> pendulum_bifurcation(double Q, double to, std::size_t steps) {
  const Example example = pendulum(Q);
  const Orbit orbit = example.orbit(600, steps);
  const LocatedBifurcation found =
      only(example.follow(orbit, "damping", 1.0 / to, 1.0 / Q, false, steps));
  return {found, 1.0 / found.parameter};
}

LocatedBifurcation duffing_bifurcation(double g, double to) {
  const Example example = duffing(g);
  // In the right-hand well.
  const Orbit orbit = example.orbit_from({1.0, 0.0}, 400, kFewSteps);
  return only(example.follow(orbit, "amplitude", g, to, true, kFewSteps));
}

TEST(Continuation, PendulumBreaksItsSymmetry) {
  const auto [found, Q] = pendulum_bifurcation(1.2, 1.3, kFewSteps);
  EXPECT_EQ(found.kind, Bifurcation::branching);
  EXPECT_EQ(found.born_of, 0U);
  EXPECT_NEAR(Q, 1.24693151, kPublished);
}

TEST(Continuation, PendulumDoublesItsPeriodFourTimes) {
  struct Doubling {
    double start, end;
    std::size_t period;
    double Q;
  };
  for (const Doubling& doubling :
       {Doubling{1.33, 1.36, 1, 1.34921264}, Doubling{1.36, 1.3705, 2, 1.37012224},
        Doubling{1.372, 1.375, 4, 1.37457590}, Doubling{1.3752, 1.3757, 8, 1.37553012}}) {
    const auto [found, Q] = pendulum_bifurcation(doubling.start, doubling.end, kFewSteps);
    EXPECT_EQ(found.kind, Bifurcation::flip);
    EXPECT_EQ(found.orbit.period, doubling.period);
    EXPECT_NEAR(Q, doubling.Q, kPublished);
  }
}

TEST(Continuation, DuffingDoublesItsPeriodThreeTimes) {
  struct Doubling {
    double start, end;
    std::size_t period;
    double g;
  };
  for (const Doubling& doubling :
       {Doubling{0.25, 0.28, 1, 0.26558179}, Doubling{0.275, 0.29, 2, 0.28669316},
        Doubling{0.289, 0.2915, 4, 0.29108991}}) {
    const LocatedBifurcation found = duffing_bifurcation(doubling.start, doubling.end);
    EXPECT_EQ(found.kind, Bifurcation::flip);
    EXPECT_EQ(found.orbit.period, doubling.period);
    EXPECT_NEAR(found.parameter, doubling.g, kPublished);
  }
}

// Fourth order: each doubling of the steps takes 15/16 of the error away, from less than 1e-6 with
// 256 steps on.
TEST(Continuation, LocatedPointsHardlyDependOnTheSteps) {
  const double coarse = pendulum_bifurcation(1.33, 1.36, 256).second;
  const double fine = pendulum_bifurcation(1.33, 1.36, 512).second;
  const double finest = pendulum_bifurcation(1.33, 1.36, 1024).second;
  EXPECT_LT(std::fabs(fine - finest), 1e-8);
  EXPECT_LT(std::fabs(coarse - finest), 1e-6);
}

// Downwards, a branch ends where it was born: the broken orbit in the symmetric one, the doubled
// orbit in the simple one. The branch turns there like a parabola.
TEST(Continuation, ABranchEndsWhereItWasBorn) {
  const Example broken = pendulum(1.3);
  const Branch to_symmetric =
      broken.follow(broken.orbit(400, kFewSteps), "damping", 1.0 / 1.3, 1.0 / 1.2, true, kFewSteps);
  EXPECT_EQ(only(to_symmetric).kind, Bifurcation::branching);
  EXPECT_EQ(only(to_symmetric).born_of, 1U);
  EXPECT_NEAR(1.0 / only(to_symmetric).parameter, 1.24693151, kPublished);

  const Example doubled = duffing(0.275);
  const Branch to_simple = doubled.follow(doubled.orbit_from({1.0, 0.0}, 400, kFewSteps),
                                          "amplitude", 0.26, 0.275, false, kFewSteps);
  EXPECT_EQ(only(to_simple).kind, Bifurcation::flip);
  EXPECT_EQ(only(to_simple).born_of, 1U);
  EXPECT_EQ(only(to_simple).orbit.period, 2U);
  EXPECT_NEAR(only(to_simple).parameter, 0.26558179, kPublished);
}

// det(M + I) = 1 + trace + determinant of Meissner's closed form; the tongue around omega = 2.
double meissner_flip(double omega) {
  const double T = 2.0 * std::numbers::pi / omega;
  const double z = 0.05;
  const double w1 = std::sqrt(0.7 - z * z), w2 = std::sqrt(1.3 - z * z);
  const double a = w1 * 0.4 * T, b = w2 * 0.6 * T;
  return 1.0 + std::exp(-2.0 * z * T) +
         std::exp(-z * T) *
             (2.0 * std::cos(a) * std::cos(b) - (w1 / w2 + w2 / w1) * std::sin(a) * std::sin(b));
}

double zero_between(double (*function)(double), double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((function(middle) < 0.0) == (function(low) < 0.0) ? low : high) = middle;
  }
  return low;
}

// The orbit in contact loses its stability at one edge of the tongue and gets it back at the other:
// the branch stays on it, and both edges have a closed form.
TEST(Continuation, StaysOnAnUnstableOrbitAcrossMeissnersTongue) {
  const Example example = meissner(1.6);
  const Branch branch = example.follow(example.orbit(300), "omega", 1.6, 2.6, true);
  ASSERT_EQ(branch.bifurcations.size(), 2U) << branch.ended;
  ASSERT_LT(meissner_flip(2.0), 0.0);
  const double edges[2] = {zero_between(meissner_flip, 1.6, 2.0),
                           zero_between(meissner_flip, 2.0, 2.6)};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(branch.bifurcations[i].kind, Bifurcation::flip);
    // Located to 1e-9 of a range of 1; the steps leave less.
    EXPECT_NEAR(branch.bifurcations[i].parameter, edges[i], 2e-9);
  }
  for (const BranchOrbit& member : branch.orbits) {
    EXPECT_EQ(member.orbit.stable(), meissner_flip(member.parameter) > 0.0) << member.parameter;
  }
}

// The harmonic resonance of a hardening oscillator bends over: the branch turns at two folds, and
// between them three orbits share each frequency, the middle one unstable.
TEST(Continuation, GoesAroundTheFoldsOfABentResonance) {
  const Example example(
      "duffing",
      {{"damping", 0.1}, {"linear", 1.0}, {"cubic", 0.2}, {"amplitude", 0.4}, {"omega", 0.8}});
  const Branch branch =
      example.follow(example.orbit(400, kFewSteps), "omega", 0.8, 2.2, true, kFewSteps);
  ASSERT_EQ(branch.bifurcations.size(), 2U) << branch.ended;
  const double upper = branch.bifurcations[0].parameter;
  const double lower = branch.bifurcations[1].parameter;
  EXPECT_GT(upper, lower);
  for (const LocatedBifurcation& found : branch.bifurcations) {
    EXPECT_EQ(found.kind, Bifurcation::fold);
    // A fold is a parabola in the branch: within 1e-6 of arclength the multiplier is that near 1.
    EXPECT_NEAR(found.orbit.multipliers[0].real(), 1.0, 1e-4);
  }
  std::size_t stable = 0, unstable = 0;
  for (const BranchOrbit& member : branch.orbits) {
    EXPECT_TRUE(member.orbit.stable() || (member.parameter < upper && member.parameter > lower));
    (member.orbit.stable() ? stable : unstable) += 1;
  }
  EXPECT_GT(stable, 0U);
  EXPECT_GT(unstable, 0U);
  EXPECT_EQ(branch.ended, "reached omega = 2.2");
}

// gear5 with impacts: from omega = 0.515 on the orbit of period 1 turns into a torus. The settled
// motion agrees: at rest on the orbit below, off it above.
TEST(Continuation, CoarseGearHasANeimarkSackerBifurcation) {
  const Example example("gear5", {{"omega", 0.515}, {"e0", 0.6}});
  const Branch branch = example.follow(example.orbit(2000, 512), "omega", 0.51, 0.525, true, 512);
  const LocatedBifurcation found = only(branch);
  EXPECT_EQ(found.kind, Bifurcation::neimark_sacker);
  // Next to the bifurcation by 1e-6 of arclength.
  EXPECT_NEAR(std::abs(found.orbit.multipliers[0]), 1.0, 1e-4);
  EXPECT_NE(found.orbit.multipliers[0].imag(), 0.0);
  for (const BranchOrbit& member : branch.orbits) {
    EXPECT_EQ(member.orbit.unstable_count(), member.parameter < found.parameter ? 0U : 2U);
  }
  for (const double side : {-0.002, 0.002}) {
    const Example beside("gear5", {{"omega", found.parameter + side}, {"e0", 0.6}});
    const PeriodMap map = beside.map(256);
    const std::vector<double> rest = beside.model->equilibrium(beside.setting);
    const Eigen::VectorXd settled =
        map.advance(Eigen::Map<const Eigen::VectorXd>(rest.data(), 10), 3000).value();
    const double moved = (map.advance(settled, 1).value() - settled).norm();
    EXPECT_EQ(moved < 1e-6, side < 0.0) << moved;
  }
}

// Nine digits of an independent integrator of order 8 that locates the impacts; what is said of the
// error holds, too.
TEST(Continuation, BifurcationsOfOrbitsWithImpactsAreThoseOfAnOutsideIntegration) {
  const Example coarse("gear5", {{"omega", 1.0}, {"e0", 0.6}});
  const Branch up = coarse.follow(coarse.orbit(400, 1024), "omega", 1.0, 1.62, true, 1024);
  const std::pair<Bifurcation, double> expected[] = {{Bifurcation::neimark_sacker, 1.03335299},
                                                     {Bifurcation::flip, 1.54086315},
                                                     {Bifurcation::neimark_sacker, 1.59767219}};
  ASSERT_EQ(up.bifurcations.size(), std::size(expected)) << up.ended;
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    EXPECT_EQ(up.bifurcations[i].kind, expected[i].first);
    EXPECT_NEAR(up.bifurcations[i].parameter, expected[i].second, 1e-8);
    EXPECT_LT(up.bifurcations[i].error, 1e-8);
    EXPECT_FALSE(up.bifurcations[i].grazing);
  }
  const Example gear1(
      "gear1",
      {{"omega", 1.03}, {"Fte", 0.1}, {"Fte_2", 0.0}, {"Fte_3", 0.0}, {"k_2", 0.0}, {"k_3", 0.0}});
  const LocatedBifurcation flip =
      only(gear1.follow(gear1.orbit(400, 1024), "omega", 1.03, 1.07, true, 1024));
  EXPECT_EQ(flip.kind, Bifurcation::flip);
  EXPECT_NEAR(flip.parameter, 1.04917463, 1e-8);
}

// The error that is told is more than the true one at any number of steps.
TEST(Continuation, LocatedPointsAreAsFarOffAsTheySay) {
  const Example example("gear5", {{"omega", 1.0}, {"e0", 0.6}});
  for (const std::size_t steps : {64U, 128U, 256U}) {
    const LocatedBifurcation found =
        only(example.follow(example.orbit(400, steps), "omega", 1.0, 1.05, true, steps));
    const double wrong = std::fabs(found.parameter - 1.033352994);
    EXPECT_LT(wrong, found.error) << steps;
    EXPECT_GT(200.0 * wrong, found.error) << steps;
  }
}

}  // namespace
}  // namespace gearsweep::testing
