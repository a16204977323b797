// Grazing curves against the closed form of linear oscillators that do not touch, or do not part.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

#include "borders/border_curve.hpp"
#include "borders/curve_accuracy.hpp"
#include "borders/find_graze.hpp"
#include "borders/orbit_way.hpp"
#include "orbits/example_orbits.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

constexpr std::size_t kGrazeSteps = 1024;

// The grazing curves near an orbit that is as large in its states as `sizes`.
std::vector<BorderCurve> curves_near(const ParameterPlane& plane, const Eigen::VectorXd& state,
                                     std::size_t steps = kGrazeSteps) {
  HostOrbitMap map(plane, steps);
  HeldOrbit orbit;
  for (std::size_t i = 0; i < 2; ++i) {
    orbit.place[i] = plane.setting.parameters[plane.parameters[i]];
  }
  orbit.state = state;
  orbit.sizes = Eigen::VectorXd::Ones(state.size());
  std::vector<BorderCurve> out;
  for (const Crossing& found : find_grazes(plane, &map, {orbit, {0.0, 1.0}, 0.5})) {
    out.push_back(follow_border(*found.equations, found.point));
  }
  return out;
}

ParameterPlane plane_over(const Example& example, const std::string& second, const PlanePlace& from,
                          const PlanePlace& to) {
  ParameterPlane plane{example.model, example.setting, {}, from, to};
  plane.parameters = {static_cast<std::size_t>(parameter_index(*example.model, "omega")),
                      static_cast<std::size_t>(parameter_index(*example.model, second))};
  return plane;
}

// How large x'' + 2 z x' + x = cos(omega t) swings.
double response(double omega, double z) {
  return 1.0 / std::hypot(1.0 - omega * omega, 2.0 * z * omega);
}

// A gear pair of constant stiffness stays on its drive flank, as a linear oscillator about Fm,
// until its swing Fte omega^2 response(omega) is Fm. There it only just parts.
TEST(Grazing, AGearPairBeginsToPartWhereItsSwingIsItsMeanDeflection) {
  const double z = 0.05, Fm = 0.1, omega = 0.7;
  const auto swing = [&](double w) { return w * w * response(w, z); };
  const Example example("gear1", {{"omega", omega},
                                  {"z", z},
                                  {"Fm", Fm},
                                  {"Fte", 0.9 * Fm / swing(omega)},
                                  {"Fte_2", 0.0},
                                  {"Fte_3", 0.0},
                                  {"k", 0.0},
                                  {"k_2", 0.0},
                                  {"k_3", 0.0}});
  const ParameterPlane plane = plane_over(example, "Fte", {0.5, 0.0}, {1.6, 0.2});
  const std::vector<BorderCurve> curves = curves_near(plane, example.orbit(400).state);
  ASSERT_EQ(curves.size(), 1U);
  const BorderCurve& curve = curves.front();
  EXPECT_FALSE(curve.limit.is_from_below);
  EXPECT_EQ(curve.begins, CurveEnd::window);
  EXPECT_EQ(curve.ends, CurveEnd::window);
  EXPECT_GE(curve.points.size(), 30U);
  EXPECT_LT(curve.max_residual(), 1e-8);
  for (const BorderPoint& point : curve.points) {
    const auto [w, Fte] = point.place;
    EXPECT_NEAR(Fte, Fm / swing(w), 1e-9) << w;
    // Till it parts it is linear: e^(-z T) is the modulus of both multipliers.
    const double modulus = std::exp(-z * 2.0 * std::numbers::pi / w);
    EXPECT_NEAR(std::abs(point.multipliers[0]), modulus, 1e-8);
  }
}

// On either flank the level of a turn changes with the start of the motion as its gradient says.
TEST(Grazing, LevelsOfBothFlanksHaveTheSlopesOfTheirDifferences) {
  const Example example("gear1", {{"omega", 0.9}, {"z", 0.05}, {"Fm", 0.1}, {"Fte", 0.4}});
  OrbitWay way(*example.model, example.setting, 256, nullptr);
  const Eigen::Vector2d start(0.3, 0.8);
  std::array<int, 2> seen{};
  for (const OrbitWay::Seen& turn : way.turns(start, 1)) {
    const auto level_from = [&](const Eigen::Vector2d& state) {
      return way.go({state, Eigen::Matrix2d::Identity()}, 2, turn.mark);
    };
    const auto here = level_from(start);
    ASSERT_TRUE(here.has_value());
    ++seen[turn.mark.limit.index];
    for (Eigen::Index i = 0; i < 2; ++i) {
      const Eigen::Vector2d step = 1e-5 * Eigen::Vector2d::Unit(i);
      const auto more = level_from(start + step), less = level_from(start - step);
      ASSERT_TRUE(more && less);
      // Squares of the step, and turns that are found to 1e-8 of their bracket, leave far less.
      EXPECT_NEAR((more->turn->level - less->turn->level) / 2e-5, here->turn->gradient[i], 1e-5)
          << "limit " << turn.mark.limit.index << ", state " << i;
    }
  }
  EXPECT_GT(seen[0], 0);
  EXPECT_GT(seen[1], 0);
}

// What moves that curve, in closed form: with G = Fte - Fm/swing(omega) the curve moves across
// itself by -G_q grad G/|grad G|^2 of the window for each unit of a parameter q.
TEST(Grazing, WhatMovesTheCurveOfAGearPairIsItsClosedForm) {
  const double z = 0.05, Fm = 0.1, omega = 0.7;
  const auto curve_at = [](double w, double damping, double load) {
    return load / (w * w * response(w, damping));
  };
  const Example example("gear1", {{"omega", omega},
                                  {"z", z},
                                  {"Fm", Fm},
                                  {"Fte", 0.9 * curve_at(omega, z, Fm)},
                                  {"Fte_2", 0.0},
                                  {"Fte_3", 0.0},
                                  {"k", 0.0},
                                  {"k_2", 0.0},
                                  {"k_3", 0.0}});
  const ParameterPlane plane = plane_over(example, "Fte", {0.5, 0.0}, {1.6, 0.2});
  std::vector<BorderCurve> curves = curves_near(plane, example.orbit(400).state, 128);
  ASSERT_EQ(curves.size(), 1U);
  PeriodPixels pixels;
  for (std::size_t i = 0; i < 2; ++i) {
    for (int k = 0; k <= 100; ++k) {
      pixels.axes[i].push_back(plane.from[i] + 0.01 * k * plane.range(i));
    }
  }
  const auto study = std::make_shared<const Study>(
      read_study("[model]\nname = \"gear1\"\n[integrate]\nsteps_per_period = 256\n"
                 "[[axes]]\nname = \"omega\"\nvalues = [1.0]\n",
                 "study"));
  // The host takes half as many steps, and alone needs no engine.
  const CurveJudge judge{plane, pixels, study};
  find_gradients(judge, &curves);
  find_step_errors(judge, &curves);
  const BorderCurve& curve = curves.front();
  const auto [w, Fte] = curve.points[curve.judged].place;
  const auto slope = [](const std::function<double(double)>& f, double at) {
    return (f(at + 1e-5) - f(at - 1e-5)) / 2e-5;
  };
  const double by_w = -slope([&](double at) { return curve_at(at, z, Fm); }, w) * plane.range(0);
  const double by_Fte = plane.range(1);
  const double square = by_w * by_w + by_Fte * by_Fte;
  const auto expect = [&](const char* parameter, double by_parameter) {
    const PlanePlace& moved =
        curve.gradients[static_cast<std::size_t>(parameter_index(*example.model, parameter))];
    // Differences of 1e-6 that make it part leave some times the root of that.
    const double near = 0.04 * std::fabs(by_parameter) / std::sqrt(square) + 1e-3;
    EXPECT_NEAR(moved[0] / plane.range(0), by_parameter * by_w / square, near) << parameter;
    EXPECT_NEAR(moved[1] / plane.range(1), by_parameter * by_Fte / square, near) << parameter;
  };
  expect("Fm", slope([&](double at) { return curve_at(w, z, at); }, Fm));
  expect("z", slope([&](double at) { return curve_at(w, at, Fm); }, z));
  // In contact the backlash is where x is counted from.
  expect("b", 0.0);
  // Steps of T/128 leave some (2 pi/128)^4/120 of a swing, 5e-8, in pixels of a hundredth.
  EXPECT_GT(curve.step_error, 1e-8);
  EXPECT_LT(curve.step_error, 1e-3);
}

// Shaw and Holmes's oscillator swings free until its swing is the gap.
TEST(Grazing, AnOscillatorTouchesItsStopWhereItsSwingIsTheGap) {
  const double z = 0.05, omega = 1.6;
  const Example example(
      "shaw_holmes", {{"omega", omega}, {"zeta", z}, {"b", 1.1 * response(omega, z)}, {"F", 1.0}});
  const ParameterPlane plane = plane_over(example, "b", {1.2, 0.1}, {3.0, 2.0});
  // At phase 0. Started at rest it would settle on a motion that impacts.
  const double square = std::pow(response(omega, z), 2.0);
  const Eigen::Vector2d free((1.0 - omega * omega) * square, 2.0 * z * omega * omega * square);
  const std::vector<BorderCurve> curves = curves_near(plane, free);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_TRUE(curves.front().limit.is_from_below);
  EXPECT_GE(curves.front().points.size(), 30U);
  for (const BorderPoint& point : curves.front().points) {
    EXPECT_NEAR(point.place[1], response(point.place[0], z), 1e-9) << point.place[0];
  }
}

// A wall throws the mass back: on one side of the graze the motion has no impact, on the other none
// that is near it. The curve is a smooth one all the same.
TEST(Grazing, AnOscillatorMeetsItsWallWhereItsSwingIsTheGap) {
  const double omega = 2.8, swing = 1.0 / (omega * omega - 1.0);
  const Example example("hard_impact", {{"omega", omega}, {"r", 0.8}, {"gap", 1.2 * swing}});
  const ParameterPlane plane = plane_over(example, "gap", {2.2, 0.05}, {3.6, 0.3});
  const std::vector<BorderCurve> curves = curves_near(plane, Eigen::Vector2d(-swing, 0.0));
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_GE(curves.front().points.size(), 20U);
  EXPECT_EQ(curves.front().begins, CurveEnd::window);
  EXPECT_EQ(curves.front().ends, CurveEnd::window);
  for (const BorderPoint& point : curves.front().points) {
    const double w = point.place[0];
    EXPECT_NEAR(point.place[1], 1.0 / (w * w - 1.0), 1e-9) << w;
  }
}

}  // namespace
}  // namespace gearsweep::testing
