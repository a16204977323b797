// How a study is cut into tiles and stages.
#include "plan/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "model/error.hpp"
#include "support/settings.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;

Plan plan_of(const std::string& toml, std::size_t tile_points) {
  return {read_study(toml, "test.toml"), tile_points};
}

std::string axis(const std::string& name, const std::string& values) {
  return "[[axes]]\nname = '" + name + "'\nvalues = " + values + "\n";
}

// 12 x 5 points with several phase grids.
const std::string kGrid =
    "[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.9\ncount = 12\n"
    "[[axes]]\nname = 'b'\nfrom = 0.2\nto = 1.0\ncount = 5\n";

std::vector<std::size_t> points_of(const Stage& stage) {
  std::vector<std::size_t> points;
  for (const Tile& tile : stage.tiles) {
    points.insert(points.end(), tile.points.begin(), tile.points.end());
  }
  std::sort(points.begin(), points.end());
  return points;
}

TEST(Plan, TilesPartitionThePoints) {
  for (const std::size_t tile_points : {1U, 7U, 60U, 1000U}) {
    const Plan plan = plan_of(kGrid, tile_points);
    ASSERT_EQ(plan.stages().size(), 1U);
    std::vector<std::size_t> all(60);
    std::iota(all.begin(), all.end(), std::size_t{0});
    EXPECT_EQ(points_of(plan.stages()[0]), all);
    for (const Tile& tile : plan.stages()[0].tiles) {
      EXPECT_LE(tile.points.size(), tile_points);
      EXPECT_FALSE(tile.points.empty());
    }
    EXPECT_EQ(plan.stages()[0].tiles.size(), (60 + tile_points - 1) / tile_points);
  }
}

// Before anything runs, with the value at which it is so.
TEST(Plan, RefusesMoreBreaksThanAPeriodMayHave) {
  const std::string study =
      "[model]\ntext = '''\n[model]\nname = 'pulses'\n[states]\nx = { unit = '1' }\n"
      "[parameters]\nn = 1.0\n[equations]\nx = \"sign(sin(n*phase)) - x\"\n"
      "[forcing]\nperiod = '2*pi'\n'''\n" +
      axis("n", "[3, 400, 5000]");
  EXPECT_THAT([&] { plan_of(study, 16); },
              ::testing::ThrowsMessage<InputError>(
                  HasSubstr("sign(sin(n*phase)) jumps or bends more than 1000 times in a period")));
}

TEST(Plan, PointsOfOnePhaseGridStandTogether) {
  const Plan plan = plan_of(kGrid + "[integrate]\nmax_step = 0.1\n", 25);
  std::set<std::size_t> grids_seen;
  for (const Tile& tile : plan.stages()[0].tiles) {
    ASSERT_FALSE(tile.grid_starts.empty());
    EXPECT_EQ(tile.grid_starts[0], 0U);
    for (std::size_t i = 1; i < tile.points.size(); ++i) {
      const bool starts = std::count(tile.grid_starts.begin(), tile.grid_starts.end(), i) > 0;
      const bool same = plan.steps_of(tile.points[i]) == plan.steps_of(tile.points[i - 1]);
      EXPECT_EQ(starts, !same) << "position " << i;
    }
    for (const std::size_t start : tile.grid_starts) {
      grids_seen.insert(plan.steps_of(tile.points[start]));
    }
  }
  EXPECT_GE(grids_seen.size(), 4U);
}

TEST(Plan, AxesThatShapeThePhaseSeparateGrids) {
  const Plan plan = plan_of(axis("eps", "[1.2, 1.4, 1.6]") + axis("omega", "[0.7, 0.71]"), 100);
  const Tile& tile = plan.stages()[0].tiles.at(0);
  EXPECT_THAT(tile.grid_starts, ElementsAre(0, 2, 4));
  for (std::size_t i = 0; i < 6; i += 2) {
    const auto eps = [&](std::size_t position) {
      return parameter_of(plan.setting_of(tile.points[position]), "eps");
    };
    EXPECT_EQ(eps(i), eps(i + 1));
  }
}

TEST(Plan, TheFirstAxisIsTheFastest) {
  const Plan plan = plan_of(axis("omega", "[0.5, 0.6, 0.7]") + axis("b", "[0.1, 0.2]"), 100);
  const ModelSetting setting = plan.setting_of(4);
  EXPECT_EQ(parameter_of(setting, "omega"), 0.6);
  EXPECT_EQ(parameter_of(setting, "b"), 0.2);
}

TEST(Plan, StepsFollowFromTheGreatestStep) {
  const Plan plan = plan_of(axis("omega", "[0.5, 1.0]") + "[integrate]\nmax_step = 0.05\n", 100);
  EXPECT_EQ(plan.steps_of(0), 256U);  // 4 pi / 0.05 = 251.3
  EXPECT_EQ(plan.steps_of(1), 128U);  // 2 pi / 0.05 = 125.7
  const Plan given = plan_of(axis("omega", "[0.5]") + "[integrate]\nsteps_per_period = 100\n", 1);
  EXPECT_EQ(given.steps_of(0), 100U);
}

TEST(Plan, RefusesAPeriodOfTooManySteps) {
  try {
    plan_of(axis("omega", "[0.0001, 0.5]") + "[integrate]\nmax_step = 0.01\n", 100);
    FAIL() << "6 million steps per period were planned";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("integrate.max_step"));
  }
}

TEST(Plan, RefusesAPointWhoseSettingIsWrong) {
  try {
    plan_of("[model]\nformulation = 'printed'\n" + axis("teeth_ratio", "[1.0, 2.0]"), 100);
    FAIL() << "unequal gears were planned with the printed formulation";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("teeth_ratio"));
  }
}

TEST(Plan, WorkIsThatOfItsTiles) {
  const Plan plan = plan_of(
      axis("omega", "[0.5, 1.0]") + "[integrate]\nmax_step = 0.05\nsettle = 3\nrecord = 2\n", 1);
  EXPECT_EQ(plan.total_work(), 5.0 * (256.0 + 128.0));
}

TEST(Plan, AChainHasAStagePerValue) {
  const std::string axes = axis("b", "[0.1, 0.2]") + axis("omega", "[0.5, 0.6, 0.7]");
  const Plan forward = plan_of(axes + "[initial]\npolicy = 'forward'\nalong = 'omega'\n", 100);
  ASSERT_EQ(forward.stages().size(), 3U);
  EXPECT_THAT(points_of(forward.stages()[0]), ElementsAre(0, 1));
  EXPECT_THAT(points_of(forward.stages()[2]), ElementsAre(4, 5));
  EXPECT_FALSE(forward.points().predecessor(1));
  EXPECT_EQ(forward.points().predecessor(5), 3U);
  const Plan backward = plan_of(axes + "[initial]\npolicy = 'backward'\nalong = 'b'\n", 100);
  ASSERT_EQ(backward.stages().size(), 2U);
  EXPECT_THAT(points_of(backward.stages()[0]), ElementsAre(1, 3, 5));
  EXPECT_FALSE(backward.points().predecessor(3));
  EXPECT_EQ(backward.points().predecessor(2), 3U);
}

// What journals and shards rely on, since they know tiles by their numbers.
TEST(Plan, TilesAreCutInTheOrderOfGridsAndSortedBySteps) {
  for (const std::string& study :
       {kGrid, axis("omega", "[0.3, 0.31, 0.7, 1.9]") + axis("eps", "[1.2, 1.4, 1.6]"),
        axis("eps", "[1.2, 1.4, 1.6]") + axis("omega", "[0.3, 0.31, 0.7, 1.9]"),
        axis("x1", "[0.1, 0.2]") + axis("omega", "[0.3, 0.7, 1.9]") +
            "[initial]\nensemble = 3\n"}) {
    Plan plan = plan_of(study, 1000);
    std::vector<std::size_t> sorted(plan.study().trajectories());
    std::iota(sorted.begin(), sorted.end(), std::size_t{0});
    std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
      return plan.grid_key(a) < plan.grid_key(b);
    });
    const double work = plan.total_work();
    for (const std::size_t tile_points : {1000U, 1U, 7U, 5U}) {
      plan.cut(tile_points);
      EXPECT_EQ(plan.tile_points(), tile_points);
      EXPECT_EQ(plan.total_work(), work);
      std::vector<std::size_t> points;
      for (const Tile& tile : plan.stages().at(0).tiles) {
        EXPECT_LE(tile.points.size(), tile_points);
        const auto first = sorted.begin() + static_cast<std::ptrdiff_t>(points.size());
        std::vector<std::size_t> expected(first,
                                          first + static_cast<std::ptrdiff_t>(tile.points.size()));
        std::ranges::stable_sort(expected, {}, [&](std::size_t i) { return plan.steps_of(i); });
        EXPECT_THAT(std::vector<std::size_t>(tile.points.begin(), tile.points.end()),
                    ElementsAreArray(expected));
        points.insert(points.end(), tile.points.begin(), tile.points.end());
      }
      EXPECT_EQ(points.size(), sorted.size());
    }
  }
}

// A study may have a hundred times as many points, and its plan is there before its maps are.
TEST(Plan, OfAMillionPointsTakesNextToNoMemory) {
  const Study study = read_study(
      "[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.9\ncount = 1000\n"
      "[[axes]]\nname = 'eps'\nfrom = 1.2\nto = 1.9\ncount = 1000\n",
      "test.toml");
  const std::size_t before = mallinfo2().uordblks;
  const Plan plan(study, 16384);
  EXPECT_LT(mallinfo2().uordblks - before, 4'000'000U);
}

TEST(Plan, AnInitialStateAxisReplacesThatState) {
  const Plan plan = plan_of(
      axis("x1", "[-0.5, 0.5]") + "[initial]\npolicy = 'fixed'\nstate = {x1 = 9.0, v2 = 0.3}\n",
      100);
  const std::vector<double> state = plan.own_initial_state(1);
  EXPECT_EQ(state[0], 0.5);
  EXPECT_EQ(state[6], 0.3);
  EXPECT_EQ(state[1], 0.0);
}

// Trajectory m of point p is point m * points + p of the plan.
TEST(Plan, AnEnsembleStartsAroundTheStudysOwnStart) {
  const std::string study =
      axis("omega", "[0.5, 0.7, 0.9]") +
      "[initial]\npolicy = 'fixed'\nstate = {x1 = 9.0}\nensemble = 50\nspread = {x1 = 2, v2 = 1}\n";
  const Plan plan = plan_of(study, 1000);
  EXPECT_EQ(points_of(plan.stages().at(0)).size(), 150U);
  EXPECT_EQ(plan.own_initial_state(2), plan.study().initial.state);
  std::set<double> starts;
  for (std::size_t member = 1; member < 50; ++member) {
    const std::vector<double> state = plan.own_initial_state(member * 3 + 1);
    EXPECT_LT(std::abs(state[0] - 9.0), 2.0);
    EXPECT_LT(std::abs(state[6]), 1.0);
    EXPECT_EQ(state[1], 0.0);
    // Points differ by their parameters alone.
    EXPECT_EQ(plan.own_initial_state(member * 3 + 2), state);
    EXPECT_EQ(plan.setting_of(member * 3 + 2).parameters, plan.setting_of(2).parameters);
    starts.insert(state[0]);
  }
  EXPECT_EQ(starts.size(), 49U);
  // They fill the box: the mean of 49 lies within three of its errors, 2/sqrt(3 * 49).
  EXPECT_NEAR(std::accumulate(starts.begin(), starts.end(), 0.0) / 49.0, 9.0, 0.5);
  const Plan again = plan_of(study, 1000);
  EXPECT_EQ(again.own_initial_state(7), plan.own_initial_state(7));
  const Plan other = plan_of(study + "seed = 2\n", 1000);
  EXPECT_NE(other.own_initial_state(7), plan.own_initial_state(7));
}

}  // namespace
}  // namespace gearsweep::testing
