// Branches that leave others, against published cascades and closed forms.
#include "orbits/branch_switch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orbits/example_orbits.hpp"

namespace gearsweep::testing {
namespace {

std::vector<LeavingBranch> leaving_of(const Example& example, const Orbit& orbit,
                                      const std::string& parameter, double from, double to,
                                      bool upwards, std::size_t generations) {
  const FollowRequest request = {
      example.model, example.setting, parameter_index(*example.model, parameter), from, to,
      kFewSteps,     upwards};
  return follow_leaving(request, {follow_orbit(request, orbit)}, generations);
}

// The values at which orbits of a period on these branches flip.
std::vector<double> flips_of(const std::vector<LeavingBranch>& leaving, std::size_t period) {
  std::vector<double> values;
  for (const LeavingBranch& one : leaving) {
    for (const Branch& branch : one.branches) {
      for (const LocatedBifurcation& found : branch.bifurcations) {
        if (found.kind == Bifurcation::flip && found.born_of == 0 && found.orbit.period == period) {
          values.push_back(found.parameter);
        }
      }
    }
  }
  return values;
}

// From the symmetric motion, which cannot double its period, through the broken one to period 8.
TEST(BranchSwitch, GoesThroughThePublishedCascadeOfThePendulum) {
  const Example example("pendulum", {{"damping", 1.0 / 1.2},
                                     {"drive", 1.5},
                                     {"omega", 2.0 / 3.0},
                                     {"phase", std::numbers::pi / 2.0}});
  const std::vector<LeavingBranch> leaving = leaving_of(
      example, example.orbit(600, kFewSteps), "damping", 1.0 / 1.3756, 1.0 / 1.2, false, 4);
  ASSERT_GE(leaving.size(), 4U);
  EXPECT_EQ(leaving[0].parent, 0U);
  EXPECT_EQ(leaving[0].origin.kind, Bifurcation::branching);
  EXPECT_EQ(leaving[0].period, 1U);
  EXPECT_NEAR(1.0 / leaving[0].origin.parameter, 1.24693151, kPublished);
  const double published[4] = {1.34921264, 1.37012224, 1.37457590, 1.37553012};
  std::size_t parent = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<double> flips = flips_of(leaving, std::size_t{1} << i);
    ASSERT_FALSE(flips.empty()) << i;
    EXPECT_TRUE(std::ranges::any_of(flips, [&](double damping) {
      return std::fabs(1.0 / damping - published[i]) < kPublished;
    })) << i;
    // Each leaves the one before, at its flip.
    if (i == 3) continue;
    const auto next = std::ranges::find_if(leaving, [&](const LeavingBranch& one) {
      return one.period == std::size_t{2} << i &&
             std::fabs(1.0 / one.origin.parameter - published[i]) < kPublished;
    });
    ASSERT_NE(next, leaving.end()) << i;
    EXPECT_EQ(next->parent, parent + 1) << i;
    parent = static_cast<std::size_t>(next - leaving.begin());
  }
}

TEST(BranchSwitch, GoesThroughThePublishedCascadeOfDuffingsWell) {
  const Example example("duffing", {{"damping", 0.3},
                                    {"linear", -1.0},
                                    {"cubic", 1.0},
                                    {"amplitude", 0.25},
                                    {"omega", 1.2},
                                    {"phase", std::numbers::pi / 2.0}});
  const std::vector<LeavingBranch> leaving = leaving_of(
      example, example.orbit_from({1.0, 0.0}, 400, kFewSteps), "amplitude", 0.25, 0.2915, true, 2);
  ASSERT_FALSE(leaving.empty());
  EXPECT_NEAR(leaving[0].origin.parameter, 0.26558179, kPublished);
  const double published[2] = {0.28669316, 0.29108991};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<double> flips = flips_of(leaving, std::size_t{2} << i);
    EXPECT_TRUE(std::ranges::any_of(flips, [&](double g) {
      return std::fabs(g - published[i]) < kPublished;
    })) << i;
  }
  // The motion settles on the doubled orbit, by a longer way.
  const auto stable = std::ranges::find_if(leaving[0].branches[0].orbits, [](const auto& member) {
    return member.parameter > 0.275 && member.orbit.stable();
  });
  ASSERT_NE(stable, leaving[0].branches[0].orbits.end());
  Example settled = example;
  settled.setting.parameters[parameter_index(*example.model, "amplitude")] = stable->parameter;
  const Orbit orbit = settled.orbit_from({1.0, 0.0}, 600, kFewSteps);
  EXPECT_EQ(orbit.period, 2U);
  const Eigen::VectorXd later = settled.map(kFewSteps).advance(stable->orbit.state, 1).value();
  EXPECT_LT(std::min((orbit.state - stable->orbit.state).norm(), (orbit.state - later).norm()),
            1e-8);
}

// A pendulum whose pivot is shaken rests, but between two flips. The branch that leaves at one of
// them comes back at the other, by way of a fold, and is followed once.
TEST(BranchSwitch, FollowsABranchThatComesBackOnce) {
  const Example example("shaken_pendulum", {{"amplitude", 0.06}, {"omega", 2.9}});
  const FollowRequest request = {
      example.model, example.setting, parameter_index(*example.model, "omega"), 1.2, 2.9, kFewSteps,
      false};
  const Branch rest = follow_orbit(request, example.orbit_from({0.0, 0.0}, 10, kFewSteps));
  ASSERT_EQ(rest.bifurcations.size(), 2U);
  const std::vector<LeavingBranch> leaving = follow_leaving(request, {rest}, 1);
  ASSERT_EQ(leaving.size(), 1U);
  EXPECT_EQ(leaving[0].origin.parameter, rest.bifurcations[0].parameter);
  ASSERT_EQ(leaving[0].branches.size(), 1U);
  const std::vector<LocatedBifurcation>& met = leaving[0].branches[0].bifurcations;
  ASSERT_EQ(met.size(), 2U);
  EXPECT_EQ(met[0].kind, Bifurcation::fold);
  EXPECT_EQ(met[1].born_of, 1U);
  // From both branches it is located to 1e-9 of the range or a few times that.
  EXPECT_NEAR(met[1].parameter, rest.bifurcations[1].parameter, 5e-8);
}

// A linear motion doubles its period at one value of the parameter, whatever its size: no direction
// leads away, and none is made up.
TEST(BranchSwitch, FindsNoBranchOfALinearMotion) {
  const Example example = meissner(1.6);
  const std::vector<LeavingBranch> leaving =
      leaving_of(example, example.orbit(300), "omega", 1.6, 2.6, true, 3);
  ASSERT_EQ(leaving.size(), 2U);
  for (const LeavingBranch& one : leaving) {
    EXPECT_EQ(one.origin.kind, Bifurcation::flip);
    EXPECT_TRUE(one.branches.empty());
  }
}

}  // namespace
}  // namespace gearsweep::testing
