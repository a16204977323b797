// An outside opinion on monodromy matrices with impacts: differences of trajectories by
// Boost.odeint, of the equations written anew (outside_gear5.cpp).
#include <gtest/gtest.h>

#include "engine/outside_gear5.hpp"
#include "orbits/example_orbits.hpp"

namespace gearsweep::testing {
namespace {

Eigen::VectorXd outside_image(const OutsideGear& gear, const Eigen::VectorXd& state) {
  OutsideState x = outside_state(std::vector<double>(state.begin(), state.end()));
  gear.advance_period(1e-13, &x);
  return Eigen::Map<const Eigen::VectorXd>(x.data(), state.size());
}

// Central differences of 1e-4 leave 4e-7 of the third derivative, which is large where a contact is
// short, and 1e-7 of what the integrations leave. Without located impacts the matrix is off by
// 1e-3.
TEST(OutsideOpinion, MonodromyWithImpacts) {
  const double shift = 1e-4;
  for (const char* backlash : {"constant", "dynamic"}) {
    for (const double omega : {0.65, 1.0}) {
      const Example example("gear5", {{"omega", omega}, {"e0", 0.6}}, {{"backlash", backlash}});
      const Orbit near = example.orbit(400, 128);
      ASSERT_EQ(near.period, 1U);
      const Orbit orbit = shoot(example.map(2048), near.state, 1).value();
      const OutsideGear gear(example.setting);
      EXPECT_LT((outside_image(gear, orbit.state) - orbit.state).cwiseAbs().maxCoeff(), 1e-10);
      for (Eigen::Index i = 0; i < 10; ++i) {
        const Eigen::VectorXd step = shift * Eigen::VectorXd::Unit(10, i);
        const Eigen::VectorXd slope =
            (outside_image(gear, orbit.state + step) - outside_image(gear, orbit.state - step)) /
            (2.0 * shift);
        EXPECT_LT((slope - orbit.monodromy.col(i)).cwiseAbs().maxCoeff(), 2e-6)
            << backlash << ' ' << omega << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
