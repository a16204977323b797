// Curves of bifurcations in the plane of two parameters, against published points, closed forms and
// the bifurcations that continuation along one parameter locates.
#include "borders/border_curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "orbits/example_orbits.hpp"
#include "borders/host_orbit_map.hpp"

namespace gearsweep::testing {
namespace {

ParameterPlane plane_of(const Example& example, const std::array<std::string, 2>& names,
                        const PlanePlace& from, const PlanePlace& to) {
  ParameterPlane plane{example.model, example.setting, {}, from, to};
  for (std::size_t i = 0; i < 2; ++i) {
    plane.parameters[i] = parameter_index(*example.model, names[i]);
  }
  return plane;
}

// The curve through the border that lies on the line of a constant second parameter.
BorderCurve curve_from(const ParameterPlane& plane, BorderKind kind, const Orbit& orbit,
                       std::size_t steps) {
  HostOrbitMap map(plane, steps);
  const BorderEquations equations(plane, &map, kind, orbit.period,
                                  {orbit.sizes, {plane.range(0), plane.range(1)}});
  BorderPoint near;
  for (std::size_t i = 0; i < 2; ++i) near.place[i] = plane.setting.parameters[plane.parameters[i]];
  near.state = orbit.state;
  const Eigen::VectorXd guess = equations.unknowns_of(near);
  const auto vectors = equations.null_vectors_near(guess);
  const Eigen::Index n = guess.size();
  const auto start = equations.correct(guess, Eigen::VectorXd::Unit(n, n - 1), *vectors, 10.0);
  EXPECT_TRUE(start.has_value());
  return start ? follow_border(equations, *start) : BorderCurve{};
}


TEST(Borders, APendulumsDoublingPassesThroughItsPublishedPoint) {
  const Example example("pendulum", {{"damping", 1.0 / 1.34},
                                     {"drive", 1.5},
                                     {"omega", 2.0 / 3.0},
                                     {"phase", std::numbers::pi / 2.0}});
  const Orbit orbit = example.orbit(600, 512);
  const ParameterPlane plane = plane_of(example, {"damping", "drive"}, {0.7, 1.4}, {0.8, 1.5});
  const BorderCurve curve = curve_from(plane, BorderKind::flip, orbit, 512);
  EXPECT_LT(curve.max_residual(), 1e-10);
  // It starts on the window's edge, where the published point is.
  EXPECT_NEAR(1.0 / curve.points.back().place[0], 1.34921264, 2e-8);
  EXPECT_EQ(curve.begins, "leaves the window");
  EXPECT_EQ(curve.ends, "leaves the window");
}

}  // namespace
}  // namespace gearsweep::testing
