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

// A model that refuses half of the plane: its other half has its numbers, in the tile and in those
// below it.
TEST(TileMaps, HaveTheNumbersBesideRefusedPoints) {
  const std::string text =
      "[model]\ntext = \"\"\"\n[model]\nname = 'half'\n[states]\nx = {}\nv = {}\n[parameters]\n"
      "F = { value = 1.0, min = 0, max = 10 }\nmu = { value = 0.1, min = 0, max = 10 }\n"
      "[equations]\nx = 'v'\nv = '-x - 0.2*v - mu + F*sin(phase)'\n"
      "[forcing]\nperiod = '2*pi'\n[checks]\n'mu {mu} must be below F {F}' = 'mu < F'\n\"\"\"\n"
      "[[axes]]\nname = 'mu'\nfrom = 0.5\nto = 0.6\ncount = 3\n"
      "[[axes]]\nname = 'F'\nfrom = 0.7\nto = 0.8\ncount = 3\n"
      "[integrate]\nmax_step = 0.1\nsettle = 4\nrecord = 2\n[observe]\nquantities = ['x_max']\n";
  const Scene scene(explored(text), {});
  const TileMaps parent = *compute_tile(scene, {0, {0, 0}}, nullptr, {});
  const TileMaps child = *compute_tile(scene, {1, {1, 0}}, &parent, {});
  std::size_t refused = 0;
  for (const auto& [maps, place] :
       {std::pair{&parent, TilePlace{0, {0, 0}}}, {&child, TilePlace{1, {1, 0}}}}) {
    for (std::size_t row = 0; row < kCells; ++row) {
      for (std::size_t column = 0; column < kCells; ++column) {
        const double mu = scene.value_at(0, place.at[0] * kCells + column, place.depth + 5);
        const double force = scene.value_at(1, place.at[1] * kCells + row, place.depth + 5);
        EXPECT_EQ(number_at(*maps, 0, row, column), mu < force ? 0.0 : kRefused)
            << mu << " " << force;
        if (mu >= force) ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100U);
  EXPECT_THAT(parent.refusal, ::testing::HasSubstr("must be below F"));
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
