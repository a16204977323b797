// A tile has the numbers of a run of its points, and takes its parent's.
#include "explore/tile_maps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "explore/explored.hpp"
#include "explore/explorer.hpp"
#include "support/bits.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::Each;

constexpr std::size_t kCells = TilePlace::kCells;
const TilePlace kPlace = {2, {1, 2}};

double number_at(const TileMaps& maps, std::size_t map, std::size_t row, std::size_t column) {
  return maps.numbers[(map * kCells + row) * kCells + column];
}

TEST(TileMaps, AreTheBitsOfARunAtTheirPoints) {
  const Scene scene(explored(), {});
  const TileMaps maps = *compute_tile(scene, kPlace, nullptr, {});
  EXPECT_EQ(maps.computed, kCells * kCells);
  for (const auto& [row, column] : {std::pair<std::size_t, std::size_t>{0, 0}, {7, 30}, {31, 5}}) {
    const double x = scene.value_at(0, kPlace.at[0] * kCells + column, kPlace.depth + 5);
    const double y = scene.value_at(1, kPlace.at[1] * kCells + row, kPlace.depth + 5);
    const SweepResult alone = run(scene.at({{{x}, {y}}}));
    EXPECT_EQ(number_at(maps, 0, row, column), alone.status[0]);
    for (std::size_t map = 0; map < alone.values.size(); ++map) {
      EXPECT_TRUE(same_bits(number_at(maps, map + 1, row, column), alone.values[map][0]));
    }
  }
}

TEST(TileMaps, ComputeThreeQuartersWhereTheParentIsThere) {
  const Scene scene(explored(), {});
  const TileMaps parent = *compute_tile(scene, kPlace.parent(), nullptr, {});
  const TileMaps alone = *compute_tile(scene, kPlace, nullptr, {}),
                 child = *compute_tile(scene, kPlace, &parent, {});
  EXPECT_EQ(child.computed, kCells * kCells / 4 * 3);
  ASSERT_EQ(child.numbers.size(), alone.numbers.size());
  for (std::size_t i = 0; i < child.numbers.size(); ++i) {
    EXPECT_TRUE(same_bits(child.numbers[i], alone.numbers[i])) << i;
  }
}

TEST(TileMaps, OfPointsThatAreRefusedAreRefused) {
  const std::string text =
      "[model]\nname = 'duffing'\n[[axes]]\nname = 'omega'\nfrom = 1e-4\nto = 1.0\ncount = 4\n"
      "[[axes]]\nname = 'amplitude'\nfrom = 0.1\nto = 0.4\ncount = 4\n"
      "[observe]\nquantities = ['x_max']\n";
  const Scene scene(explored(text), {});
  const TileMaps maps = *compute_tile(scene, {30, {0, 0}}, nullptr, {});
  EXPECT_EQ(number_at(maps, 0, 3, 3), kRefused);
  EXPECT_TRUE(std::isnan(number_at(maps, 1, 3, 3)));
  EXPECT_NE(maps.refusal.find("steps"), std::string::npos) << maps.refusal;
}

TEST(Explorer, KeepsTilesAndForgetsThoseThatWereNotUsedForLong) {
  Explorer explorer(
      explored(), {.source = "test", .is_model = false, .devices = {}, .max_bytes = 3 * 4 * 8192});
  const auto scene = explorer.make_scene({});
  const std::atomic<bool> never = false;
  const auto first = explorer.tile(*scene, {1, {0, 0}}, never);
  EXPECT_EQ(first, explorer.tile(*scene, {1, {0, 0}}, never));
  EXPECT_GT(explorer.points_per_second(), 0.0);
  for (const std::uint64_t i : {5U, 6U, 7U}) explorer.tile(*scene, {3, {i, 0}}, never);
  EXPECT_LE(explorer.bytes(), 3U * 4 * 8192);
  EXPECT_NE(first, explorer.tile(*scene, {1, {0, 0}}, never));
}

TEST(Explorer, StopsATileThatNobodyWantsAnyMore) {
  Explorer explorer(explored(), {.source = "test", .is_model = false, .devices = {}});
  const std::atomic<bool> stop = true;
  EXPECT_EQ(explorer.tile(*explorer.make_scene({}), {1, {0, 0}}, stop), nullptr);
}

}  // namespace
}  // namespace gearsweep::testing
