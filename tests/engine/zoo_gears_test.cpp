// Gears of the zoo against answers that take code: exact orbits, Hill's method, limits. Those that
// are numbers stand in the models' files (zoo/).
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "engine/hill.hpp"
#include "engine/zoo_answers.hpp"

namespace gearsweep::testing {
namespace {

// ---- gear_friction -----------------------------------------------------------------------------

// With equal gears the lever of friction is the same all along the line of action, and the mesh is
// piecewise constant: both pairs slide against each other while there are two, then one pair before
// the pitch point, then one behind it. Friction and stiffness alone make the teeth part in the
// second case, with a transmission error in the third.
TEST(ZooGearFriction, OrbitOfEqualGearsIsTheExactOne) {
  struct Case {
    double omega, mu, e;
    std::size_t crossings;
  };
  for (const Case& one : {Case{1.2, 0.1, 0.0, 0}, {0.74, 0.1, 0.0, 2}, {0.7, 0.3, 0.3, 2}}) {
    const double eps = 1.6, b = 1.0, F = 0.2, zeta = 0.03;
    const double lever = one.mu * std::tan(20.0 * std::numbers::pi / 180.0);
    ExactPieces exact = {.omega = one.omega,
                         .limits = {{vector_of({1.0, 0.0}), b}, {vector_of({-1.0, 0.0}), b}},
                         .field = {},
                         .spells = {eps - 1.0, 0.5 * eps, 1.0}};
    exact.field = [&](const Sides& beyond, std::size_t spell) {
      const double mesh = (spell == 0 ? 2.0 : spell == 1 ? 1.0 - lever : 1.0 + lever) / eps;
      const double touch = beyond[0] || beyond[1] ? mesh : 0.0;
      LinearField field(2);
      field.slope << 0.0, 1.0, -touch, -2.0 * zeta * mesh;
      field.constant[1] = F + (beyond[0] ? touch * b : 0.0) - (beyond[1] ? touch * b : 0.0);
      field.cosine[1] = one.e * one.omega * one.omega;
      return field;
    };
    const Example example("gear_friction", {{"omega", one.omega}, {"mu", one.mu}, {"e", one.e}});
    // (h w)^4/120 is 5e-11 for each unit of phase, of which a period has some ten.
    expect_orbit(example, exact, one.crossings, 1e-9);
  }
}

// The divergence is -2 zeta times the mesh, whose mean over the way of a pair, from 0 to eps with
// the pitch point at p, is
// 1 - mu/eps (tan(alpha) (2 p - eps) - turn (p^2 + (eps - p)^2)/2),
// in contact and out of it. The equations jump at phases that steps end at, and steps are cut at
// the limits, so that nothing but the fourth order of 512 steps is left.
TEST(ZooGearFriction, ExponentsAddUpToTheMeanOfTheFriction) {
  const double eps = 1.7, p = 0.4 * eps, mu = 0.3, zeta = 0.03, share = 0.3, ratio = 2.0, z = 20.0;
  const double turn = (share - (1.0 - share) / ratio) * 2.0 * std::numbers::pi / z;
  const double slip = std::tan(20.0 * std::numbers::pi / 180.0) * (2.0 * p - eps) -
                      0.5 * turn * (p * p + (eps - p) * (eps - p));
  const double mean = 1.0 - mu / eps * slip;
  const double omega = 1.2;
  const Example example("gear_friction", {{"omega", omega},
                                          {"mu", mu},
                                          {"e", 0.3},
                                          {"eps", eps},
                                          {"approach", 0.4},
                                          {"share", share},
                                          {"ratio", ratio},
                                          {"z", z}});
  // One period from a start between the flanks, of which it meets one.
  const PeriodImage image = example.map(512).linearize(vector_of({0.9, 0.2}), 1).value();
  EXPECT_NEAR(std::log(image.monodromy.determinant()) / (2.0 * std::numbers::pi / omega),
              -2.0 * zeta * mean, 1e-10);
}

// ---- blankenship_kahraman ----------------------------------------------------------------------

const std::string kKahraman = "'period', 'contact_gap', 'contact_back', 'x_max'";

// In contact the deflection obeys Mathieu's equation under a load; teeth part where its smallest
// value reaches 0. Above the resonance that is the frequency at which a falling sweep jumps up.
TEST(ZooBlankenshipKahraman, TeethPartWhereMathieusMotionReachesZero) {
  const double kappa = 0.15, zeta = 0.03;
  double low = 1.0, high = 1.3;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    const Hill hill = {.damping = 2.0 * zeta, .kappa = kappa, .omega = middle};
    (hill.least(1.0) < 0.0 ? low : high) = middle;
  }
  // 4096 phases miss the smallest value by 1e-6 of the amplitude.
  for (const double part : {1.0 - 1e-5, 1.0 + 1e-5}) {
    const Points points = {.model = "blankenship_kahraman",
                           .parameters = "",
                           .axis = at_omega(low * part),
                           .start = {},
                           .quantities = kKahraman};
    const double gap = map_of(points.run(), "contact_gap")[0];
    EXPECT_EQ(gap > 0.0, part < 1.0) << low << ' ' << gap;
  }
}

// With parametric excitation alone, and while the back flank is not met, the force beyond the drive
// flank is homogeneous of degree one: with the load grows all of the motion from there, and nothing
// moves in frequency.
TEST(ZooBlankenshipKahraman, TheLoadScalesTheMotionAndMovesNoJump) {
  std::vector<double> highest, gaps;
  for (const double F : {0.05, 0.1, 0.2}) {
    const Points points = {.model = "blankenship_kahraman",
                           .parameters = "F = " + digits(F),
                           .axis = at_omega(0.95),
                           .start = {},
                           .quantities = kKahraman};
    const SweepResult result = points.run();
    EXPECT_EQ(map_of(result, "contact_back")[0], 0.0);
    highest.push_back((map_of(result, "x_max")[0] - 1.0) / F);
    gaps.push_back(map_of(result, "contact_gap")[0]);
  }
  EXPECT_GT(gaps[0], 0.1);
  for (std::size_t i : {1, 2}) {
    // The same numbers but for rounding, which grows with b/F.
    EXPECT_NEAR(highest[i], highest[0], 1e-10);
    EXPECT_NEAR(gaps[i], gaps[0], 1e-10);
  }
}

// Around twice the natural frequency the motion in contact is unstable from a kappa on that Hill's
// method gives; below, its exponent is Hill's.
TEST(ZooBlankenshipKahraman, ItsExponentsInContactAreHills) {
  for (const double kappa : {0.05, 0.1}) {
    const Hill hill = {.damping = 0.06, .kappa = kappa, .omega = 2.0};
    const Example example("blankenship_kahraman", {{"omega", 2.0}, {"kappa", kappa}});
    const std::complex<double> largest = example.orbit(200, 512).multipliers[0];
    // (h w)^4/120 of steps of 0.006.
    EXPECT_NEAR(std::log(std::abs(largest)) / std::numbers::pi, hill.exponent(), 1e-10);
  }
  const Hill beyond = {.damping = 0.06, .kappa = 0.15, .omega = 2.0};
  ASSERT_GT(beyond.exponent(), 0.0);
  const Points points = {.model = "blankenship_kahraman",
                         .parameters = "kappa = 0.15",
                         .axis = at_omega(2.0),
                         .start = {},
                         .quantities = kKahraman};
  const SweepResult result = points.run();
  EXPECT_EQ(map_of(result, "period")[0], 2.0);
  EXPECT_GT(map_of(result, "contact_gap")[0], 0.0);
}

// ---- idler -------------------------------------------------------------------------------------

// Both meshes part, and meet their back flanks. With 30 teeth of the idler and the last gear
// straight behind it, the tooth between both flanks puts the second mesh half a period off.
TEST(ZooIdler, OrbitWithBothMeshesPartingIsTheExactOne) {
  const double omega = 0.9, F = 0.1, b1 = 1.0, b2 = 0.6, k = 1.3, m = 0.45, e1 = 0.5, e2 = 0.36,
               zeta = 0.05;
  // Over the mobility of driver and idler: driver, idler, last gear; dampers of both meshes.
  const double M1 = 1.0 / 0.55, M2 = 1.0 / m, M3 = M2 * 0.6 / 0.4, me2 = 0.6 * M2;
  const double c1 = 2.0 * zeta, c2 = 2.0 * zeta * std::sqrt(k * me2);
  ExactPieces exact = {.omega = omega,
                       .limits = {{vector_of({1.0, 0.0, 0.0, 0.0}), b1},
                                  {vector_of({-1.0, 0.0, 0.0, 0.0}), b1},
                                  {vector_of({0.0, 1.0, 0.0, 0.0}), b2},
                                  {vector_of({0.0, -1.0, 0.0, 0.0}), b2}},
                       .field = {}};
  exact.field = [&](const Sides& beyond, std::size_t) {
    const double first = beyond[0] || beyond[1] ? 1.0 : 0.0;
    const double second = beyond[2] || beyond[3] ? k : 0.0;
    const double first_rest = (beyond[0] ? -b1 : 0.0) + (beyond[1] ? b1 : 0.0);
    const double second_rest = k * ((beyond[2] ? -b2 : 0.0) + (beyond[3] ? b2 : 0.0));
    const double driver = 1.0 / M1 + 1.0 / M2, last = 1.0 / M3 + 1.0 / M2;
    LinearField field(4);
    field.slope << 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, -driver * first, second / M2,
        -driver * c1, c2 / M2, first / M2, -last * second, c1 / M2, -last * c2;
    field.constant << 0.0, 0.0, F / M1 - driver * first_rest + second_rest / M2,
        F / M3 + first_rest / M2 - last * second_rest;
    // The errors are sines where a pair enters: a quarter of a period before the cosines are.
    field.cosine << 0.0, 0.0, e1 * omega * omega, -e2 * omega * omega;
    return field;
  };
  const Example example("idler",
                        {{"omega", omega},
                         {"e0_first", e1},
                         {"e0_second", e2 / b2},
                         {"e0_phase_first", 0.5 * std::numbers::pi},
                         {"e0_phase_second", 0.5 * std::numbers::pi}},
                        {{"stiffness_first", "constant"}, {"stiffness_second", "constant"}});
  expect_orbit(example, exact, 8, 1e-8);
}

// ---- two_flanks --------------------------------------------------------------------------------

TEST(ZooTwoFlanks, OrbitOnBothFlanksIsTheExactOne) {
  const double omega = 0.8, F = 0.1, e = 0.5, zeta = 0.05, drive_gap = 1.0, coast_gap = 0.4,
               coast = 4.0;
  ExactPieces exact = {
      .omega = omega,
      .limits = {{vector_of({1.0, 0.0}), drive_gap}, {vector_of({-1.0, 0.0}), coast_gap}},
      .field = {}};
  exact.field = [&](const Sides& beyond, std::size_t) {
    LinearField field(2);
    field.slope << 0.0, 1.0, beyond[0] ? -1.0 : beyond[1] ? -coast : 0.0, -2.0 * zeta;
    field.constant[1] = F + (beyond[0] ? drive_gap : 0.0) - (beyond[1] ? coast * coast_gap : 0.0);
    field.cosine[1] = e * omega * omega;
    return field;
  };
  // (h w)^4/120 at w = 2 and h = 0.008 is 5e-10.
  expect_orbit(Example("two_flanks", {{"omega", omega}, {"coast_stiffness", coast}}), exact, 4,
               1e-9);
}

}  // namespace
}  // namespace gearsweep::testing
