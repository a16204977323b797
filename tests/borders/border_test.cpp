// Curves of bifurcations in the plane of two parameters, against published points, closed forms and
// motions on both sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "borders/border_curve.hpp"
#include "borders/host_orbit_map.hpp"
#include "orbits/example_orbits.hpp"

namespace gearsweep::testing {
namespace {

using std::numbers::pi;

ParameterPlane plane_of(const Example& example, const std::array<std::string, 2>& names,
                        const PlanePlace& from, const PlanePlace& to) {
  ParameterPlane plane{example.model, example.setting, {}, from, to};
  for (std::size_t i = 0; i < 2; ++i) {
    plane.parameters[i] = parameter_index(*example.model, names[i]);
  }
  return plane;
}

// The curve through the border that Newton's method finds from an orbit, at the second parameter of
// the orbit.
BorderCurve curve_from(const ParameterPlane& plane, BorderKind kind, const Orbit& orbit,
                       std::size_t steps) {
  HostOrbitMap map(plane, steps);
  const BorderEquations equations(plane, &map, kind, orbit.period,
                                  {orbit.sizes, {plane.range(0), plane.range(1)}});
  BorderPoint near;
  for (std::size_t i = 0; i < 2; ++i) near.place[i] = plane.setting.parameters[plane.parameters[i]];
  near.state = orbit.state;
  near.angle = std::arg(orbit.multipliers[0]);
  const Eigen::VectorXd guess = equations.unknowns_of(near);
  const auto vectors = equations.critical_near(guess);
  const Eigen::Index n = guess.size();
  const auto start = equations.correct(guess, Eigen::VectorXd::Unit(n, n - 1), *vectors, 10.0);
  EXPECT_TRUE(start.has_value());
  return start ? follow_border(equations, *start) : BorderCurve{};
}

Example pendulum(double damping, double drive) {
  return Example(
      "pendulum",
      {{"damping", damping}, {"drive", drive}, {"omega", 2.0 / 3.0}, {"phase", pi / 2.0}});
}

// x'' + damping x' + sin x = drive cos(2 t/3) by the classical method: how far the state is from
// where it was one period before, after many.
double shift_in_a_period(double damping, double drive) {
  constexpr int kSteps = 400, kPeriods = 3000;
  const double period = 3.0 * pi, h = period / kSteps;
  double x = 0.0, v = 0.0, x_before = 0.0, v_before = 0.0;
  const auto force = [&](double t, double place, double speed) {
    return drive * std::cos(2.0 * t / 3.0) - damping * speed - std::sin(place);
  };
  for (int n = 0; n < kPeriods; ++n) {
    x_before = x;
    v_before = v;
    for (int i = 0; i < kSteps; ++i) {
      const double t = i * h;
      const double a1 = force(t, x, v), x2 = x + 0.5 * h * v, v2 = v + 0.5 * h * a1;
      const double a2 = force(t + 0.5 * h, x2, v2), x3 = x + 0.5 * h * v2, v3 = v + 0.5 * h * a2;
      const double a3 = force(t + 0.5 * h, x3, v3), x4 = x + h * v3, v4 = v + h * a3;
      const double a4 = force(t + h, x4, v4);
      x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
      v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    }
  }
  return std::hypot(std::remainder(x - x_before, 2.0 * pi), v - v_before);
}

TEST(Borders, APendulumsDoublingPassesThroughItsPublishedPoint) {
  const Example example = pendulum(1.0 / 1.34, 1.5);
  const ParameterPlane plane = plane_of(example, {"damping", "drive"}, {0.7, 1.4}, {0.8, 1.5});
  const BorderCurve curve = curve_from(plane, BorderKind::flip, example.orbit(600, 512), 512);
  EXPECT_LT(curve.max_residual(), 1e-10);
  EXPECT_EQ(curve.begins, CurveEnd::window);
  EXPECT_EQ(curve.ends, CurveEnd::window);
  // It starts on the window's edge, where the published point is.
  EXPECT_NEAR(1.0 / curve.points.back().place[0], 1.34921264, 2e-8);
  for (const BorderPoint& point : curve.points) {
    EXPECT_NEAR(point.multipliers[0].real(), -1.0, 1e-8);
    EXPECT_TRUE(point.is_of_stable_motion());
  }
}

// On the damped side the motion has the period of the drive, on the other one twice that.
TEST(Borders, APendulumsMotionDoublesAcrossItsCurve) {
  const Example example = pendulum(1.0 / 1.34, 1.5);
  const ParameterPlane plane = plane_of(example, {"damping", "drive"}, {0.7, 1.4}, {0.8, 1.5});
  const BorderCurve curve = curve_from(plane, BorderKind::flip, example.orbit(600, 512), 512);
  for (const double share : {0.2, 0.5, 0.8}) {
    const auto i = static_cast<std::size_t>(share * static_cast<double>(curve.points.size()));
    const auto [damping, drive] = curve.points[i].place;
    EXPECT_LT(shift_in_a_period(damping + 5e-4, drive), 1e-6) << damping << ", " << drive;
    EXPECT_GT(shift_in_a_period(damping - 5e-4, drive), 1e-2) << damping << ", " << drive;
  }
}

// A gear with square-wave stiffness 1 -+ k, soft for 0.4 of the period, in contact:
// det(M + I) = 1 + trace + determinant, in closed form (E. Meissner, 1918).
double meissner_flip(double omega, double k) {
  const double T = 2.0 * pi / omega, z = 0.05;
  const double w1 = std::sqrt(1.0 - k - z * z), w2 = std::sqrt(1.0 + k - z * z);
  const double a = w1 * 0.4 * T, b = w2 * 0.6 * T;
  return 1.0 + std::exp(-2.0 * z * T) +
         std::exp(-z * T) *
             (2.0 * std::cos(a) * std::cos(b) - (w1 / w2 + w2 / w1) * std::sin(a) * std::sin(b));
}

TEST(Borders, MeissnersTongueHasItsClosedForm) {
  const Example example = meissner(1.6);
  const ParameterPlane plane = plane_of(example, {"omega", "k"}, {1.5, 0.15}, {2.6, 0.45});
  const BorderCurve curve = curve_from(plane, BorderKind::flip, example.orbit(300), kSteps);
  ASSERT_GE(curve.points.size(), 30U);
  double narrowest = 1.0;
  for (const BorderPoint& point : curve.points) {
    const auto [omega, k] = point.place;
    const double slope = (meissner_flip(omega + 1e-6, k) - meissner_flip(omega - 1e-6, k)) / 2e-6;
    const double across = (meissner_flip(omega, k + 1e-6) - meissner_flip(omega, k - 1e-6)) / 2e-6;
    EXPECT_LT(std::abs(meissner_flip(omega, k)) / std::hypot(slope, across), 1e-8);
    narrowest = std::min(narrowest, k);
  }
  // The tip, around which the curve goes: with damping there is no tongue below some k.
  EXPECT_GT(narrowest, 0.15);
}

// The resonance of a hardening oscillator bends over at two folds, which meet in a cusp where the
// drive is too weak to bend it. Harmonic balance of one term: with s = 0.75 c a^2 and W = w^2,
// s ((1 + s - W)^2 + d^2 W) = 0.75 c f^2. Where both derivatives of the left by s are 0, W = 1
// + 1.5 s and s^2 = 4/3 d^2 W.
TEST(Borders, FoldsOfABentResonanceMeetInACusp) {
  Example example(
      "duffing",
      {{"damping", 0.1}, {"linear", 1.0}, {"cubic", 0.02}, {"amplitude", 0.5}, {"omega", 0.95}});
  const Branch branch = example.follow(example.orbit(600, 512), "omega", 0.95, 1.3, true, 512);
  ASSERT_EQ(branch.bifurcations.size(), 2U) << branch.ended;
  const LocatedBifurcation& fold = branch.bifurcations.front();
  example.setting.parameters[parameter_index(*example.model, "omega")] = fold.parameter;
  const ParameterPlane plane = plane_of(example, {"omega", "amplitude"}, {0.9, 0.1}, {1.4, 0.6});
  const BorderCurve curve = curve_from(plane, BorderKind::fold, fold.orbit, 512);
  ASSERT_GE(curve.points.size(), 20U);
  // Up to the drive's largest value along one fold, over the cusp, and along the other.
  EXPECT_EQ(curve.begins, CurveEnd::window);
  EXPECT_EQ(curve.ends, CurveEnd::window);
  ASSERT_EQ(curve.special.size(), 1U);
  EXPECT_EQ(curve.special.front().kind, SpecialKind::cusp);
  const double d = 0.1, c = 0.02;
  const double s = d * d + std::sqrt(d * d * d * d + 4.0 / 3.0 * d * d);
  const double W = 1.0 + 1.5 * s;
  const double f = std::sqrt(s / (0.75 * c) * (0.25 * s * s + d * d * W));
  // One term of the harmonic balance leaves out the third harmonic, of relative size c a^2 / 32,
  // 0.5 %, and its effect back, of the square of that; neighbours on the curve add as much.
  EXPECT_NEAR(curve.special.front().place[0], std::sqrt(W), 2e-3);
  EXPECT_NEAR(curve.special.front().place[1], f, 2e-3);
}

}  // namespace
}  // namespace gearsweep::testing
