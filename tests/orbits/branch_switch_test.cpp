// Branches that leave others, against published cascades and closed forms.
#include "orbits/branch_switch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orbits/example_orbits.hpp"
#include "orbits/orbit_findings.hpp"

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

// Cycles of Roessler's flow double their returns and their time. The values are those of shooting
// by SciPy's DOP853 at 1e-13 and Brent's method.
TEST(BranchSwitch, GoesThroughTheCascadeOfCycles) {
  const Example example("rossler", {{"c", 2.5}});
  const PeriodMap map = example.map();
  const Eigen::VectorXd settled =
      map.advance(Eigen::Vector3d(1.0, 1.0, 1.0), TimeSpan{500.0, 25000}).value();
  const Orbit cycle = find_cycle(map, settled, {0.02, kSteps, {}});
  const std::vector<LeavingBranch> leaving = leaving_of(example, cycle, "c", 2.5, 4.15, true, 2);
  ASSERT_EQ(leaving.size(), 2U);
  const double flips[3] = {2.83244502786, 3.83735816841, 4.12421473208};
  for (std::size_t i = 0; i < 2; ++i) {
    const LeavingBranch& one = leaving[i];
    EXPECT_EQ(one.parent, i);
    EXPECT_EQ(one.period, std::size_t{2} << i);
    EXPECT_EQ(one.origin.kind, Bifurcation::flip);
    EXPECT_NEAR(one.origin.parameter, flips[i], kPublished);
    ASSERT_EQ(one.branches.size(), 1U);
    EXPECT_TRUE(one.branches[0].upwards);
    const BranchOrbit& last = one.branches[0].orbits.back();
    EXPECT_GT(last.parameter, 4.1);
    EXPECT_EQ(last.orbit.period, one.period);
    const std::vector<double> own = flips_of(leaving, one.period);
    ASSERT_EQ(own.size(), 1U);
    EXPECT_NEAR(own[0], flips[i + 1], kPublished);
  }
}

// The cascade of Lorenz's cycles below 100.795 (V. Franceschini, Journal of Statistical Physics 22
// (1980) 397-406), in the digits that are published; the cycle is born at a fold (C. Sparrow, The
// Lorenz Equations, 1982).
TEST(BranchSwitch, GoesThroughThePublishedCascadeOfLorenz) {
  const Example example("lorenz", {{"rho", 100.2}});
  const PeriodMap map = example.map();
  const Eigen::VectorXd settled =
      map.advance(Eigen::Vector3d(1.0, 1.0, 1.0), TimeSpan{200.0, 40000}).value();
  const Orbit cycle = find_cycle(map, settled, {0.005, kFewSteps, {}});
  const std::vector<LeavingBranch> leaving =
      leaving_of(example, cycle, "rho", 99.54, 100.2, false, 2);
  ASSERT_EQ(leaving.size(), 2U);
  EXPECT_NEAR(leaving[0].origin.parameter, 99.98, 5e-3);
  const double doublings[2] = {99.629, 99.547};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(leaving[i].parent, i);
    EXPECT_EQ(leaving[i].period, cycle.period << (i + 1));
    const std::vector<double> flips = flips_of(leaving, leaving[i].period);
    ASSERT_EQ(flips.size(), 1U);
    EXPECT_NEAR(flips[0], doublings[i], 5e-4);
  }
  EXPECT_EQ(leaving[1].origin.parameter, flips_of(leaving, leaving[0].period)[0]);
  const Branch up = example.follow(cycle, "rho", 100.0, 101.0, true, kFewSteps);
  ASSERT_FALSE(up.bifurcations.empty());
  EXPECT_EQ(up.bifurcations[0].kind, Bifurcation::fold);
  EXPECT_NEAR(up.bifurcations[0].parameter, 100.795, 5e-4);
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

// Both ways of a branch that leaves stand in one line, from the range's beginning to its end.
TEST(BranchSwitch, OrbitsOfBothWaysStandInOneLine) {
  const auto way = [](bool upwards, const std::vector<double>& values) {
    Branch branch;
    branch.upwards = upwards;
    for (const double value : values) branch.orbits.push_back({value, {}});
    return branch;
  };
  LeavingBranch leaving;
  leaving.branches = {way(true, {0.1, 0.3}), way(false, {-0.1, -0.2})};
  OrbitFindings findings;
  const auto values_from = [&](double from, double to) {
    findings.range = FollowedRange{0, from, to};
    std::vector<double> values;
    for (const BranchOrbit& member : orbits_of(findings, leaving)) {
      values.push_back(member.parameter);
    }
    return values;
  };
  EXPECT_EQ(values_from(-0.5, 0.5), (std::vector<double>{-0.2, -0.1, 0.1, 0.3}));
  EXPECT_EQ(values_from(0.5, -0.5), (std::vector<double>{0.3, 0.1, -0.1, -0.2}));
}

}  // namespace
}  // namespace gearsweep::testing
