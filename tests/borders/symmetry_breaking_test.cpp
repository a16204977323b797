// Where a mirrored motion breaks into a pair of others, against an independent program.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "borders/border_curve.hpp"
#include "borders/find_breaking.hpp"
#include "borders/mirror_symmetry.hpp"
#include "orbits/example_orbits.hpp"

namespace gearsweep::testing {
namespace {

ParameterPlane plane_between(const Example& example, const std::array<std::string, 2>& names,
                             const PlanePlace& from, const PlanePlace& to) {
  ParameterPlane plane{example.model, example.setting, {}, from, to};
  for (std::size_t i = 0; i < 2; ++i) {
    plane.parameters[i] = parameter_index(*example.model, names[i]);
  }
  return plane;
}

// Damping and drive.
constexpr std::array<std::array<double, 2>, 4> kDrives = {{{0.4, 0.842932487965728},
                                                           {0.45, 0.923086379155994},
                                                           {0.55, 1.0861924918196155},
                                                           {0.6, 1.1683904446740687}}};

// x'' + damping x' + sin x = drive cos(2 t/3) swings to both sides alike, until it does not. The
// drives at which it breaks are those of SciPy's DOP853 (tolerance 1e-13): Newton's method for the
// orbit, Brent's for the drive at which det(D + 1) of the mirrored half of the return map is 0.
TEST(SymmetryBreaking, APendulumsIsThatOfAnIndependentProgram) {
  const double half_turn = std::numbers::pi / 2.0;
  const Example example(
      "pendulum", {{"damping", 0.5}, {"drive", 0.95}, {"omega", 2.0 / 3.0}, {"phase", half_turn}});
  const ParameterPlane plane =
      plane_between(example, {"damping", "drive"}, {0.35, 0.8}, {0.65, 1.2});
  ASSERT_TRUE(is_mirrored(plane));
  HostOrbitMap map(plane, 1024);
  const Orbit settled = example.orbit(300, 1024);
  const HeldOrbit orbit{{0.5, 0.95}, 1, settled.state, settled.sizes, settled.multipliers};
  ASSERT_TRUE(is_own_image(plane, &map, orbit));
  const std::optional<Crossing> found = find_breaking(plane, &map, orbit, {0.5, 1.0}, 2.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->point.place[1], 1.00431947742646, 1e-9);
  const BorderCurve curve = follow_border(*found->equations, found->point);
  EXPECT_EQ(curve.begins, CurveEnd::window);
  EXPECT_EQ(curve.ends, CurveEnd::window);
  for (const auto& [damping, drive] : kDrives) {
    const auto nearest = std::ranges::min_element(curve.points, {}, [&](const BorderPoint& point) {
      return std::fabs(point.place[0] - damping);
    });
    Eigen::VectorXd guess = found->equations->unknowns_of(*nearest);
    const Eigen::Index n = guess.size();
    guess[n - 2] = damping / plane.range(0);
    const std::optional<BorderPoint> there =
        found->equations->correct(guess, Eigen::VectorXd::Unit(n, n - 2), nearest->critical, 1.0);
    ASSERT_TRUE(there) << damping;
    EXPECT_NEAR(there->place[1], drive, 1e-9) << damping;
    // The multiplier of the whole return map is +1.
    EXPECT_LT(std::abs(there->multipliers[0] - 1.0), 1e-6);
  }
}

TEST(SymmetryBreaking, AGearUnderLoadHasNoMirrorImage) {
  const Example example("gear1", {});
  EXPECT_FALSE(is_mirrored(plane_between(example, {"omega", "Fte"}, {0.5, 0.0}, {1.5, 0.1})));
}

}  // namespace
}  // namespace gearsweep::testing
