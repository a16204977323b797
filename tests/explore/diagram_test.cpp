// Strips of a diagram are nested, and have the samples of a run at their points.
#include "explore/diagram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "explore/explored.hpp"
#include "support/bits.hpp"
#include "support/run.hpp"

namespace gearsweep::testing {
namespace {

constexpr std::size_t kStripCells = Strip::kCells;

TEST(Diagram, HasTheSamplesOfARunAtItsCells) {
  const Scene scene(explored(), {});
  const Line line = {0, 5, 11};
  const StripMaps maps = *compute_strip(scene, line, {2, 1}, {});
  const std::size_t quantities = scene.study().selection.quantities.size();
  ASSERT_EQ(maps.samples, 8U);
  ASSERT_EQ(maps.numbers.size(), kStripCells * (1 + quantities + 2 * maps.samples));
  for (const std::size_t cell : {0U, 77U}) {
    const double x = scene.value_at(0, 2 * (kStripCells + cell) + 1, 9),
                 y = scene.value_at(1, 11, 5);
    const SweepResult alone = run(scene.sampled_at({{{x}, {y}}}));
    EXPECT_EQ(maps.numbers[cell], alone.status[0]);
    for (std::size_t i = 0; i < quantities; ++i) {
      EXPECT_TRUE(same_bits(maps.numbers[(1 + i) * kStripCells + cell], alone.values[i][0]));
    }
    const std::vector<double> of_v = samples_of(alone, 0, 1);
    const std::size_t first = kStripCells * (1 + quantities) + (kStripCells + cell) * maps.samples;
    for (std::size_t i = 0; i < maps.samples; ++i) {
      EXPECT_TRUE(same_bits(maps.numbers[first + i], of_v[i])) << cell << " " << i;
    }
  }
}

// Observing samples, too, changes no quantity.
TEST(Diagram, HasTheQuantitiesOfTheMap) {
  const Scene scene(explored(), {});
  const std::array<std::vector<double>, 2> at = {
      {{scene.value_at(0, 0.5)}, {scene.value_at(1, 0.5)}}};
  const SweepResult map = run(scene.at(at)), sampled = run(scene.sampled_at(at));
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    EXPECT_TRUE(same_bits(map.values[i][0], sampled.values[i][0]));
  }
}

TEST(Diagram, IsMadeOfStripsThatHaveEachCellOnce) {
  std::set<std::uint64_t> cells;  // at depth 3 + 7
  std::size_t strips = 0;
  for (std::size_t depth = 0; depth <= 3; ++depth) {
    for (std::uint64_t i = 0; Strip{depth, i}.is_there(); ++i, ++strips) {
      for (std::uint64_t j = 0; j < kStripCells; ++j) {
        const std::uint64_t k = depth == 0 ? j : 2 * (kStripCells * i + j) + 1;
        EXPECT_TRUE(cells.insert(k << (3 - depth)).second);
      }
    }
  }
  EXPECT_EQ(strips, 8U);
  EXPECT_EQ(cells.size(), 8 * kStripCells);
  EXPECT_EQ(*cells.rbegin(), 8 * kStripCells - 1);
}

// A motion without forcing is sampled where its model says, once a return; one that rests is where
// it rests. Below b = 1 + a^2 the brusselator rests at x = a, above x has maxima.
TEST(Diagram, OfAModelWithoutForcingIsTakenAtItsSection) {
  const std::string text =
      "[model]\nname = 'brusselator'\n[[axes]]\nname = 'b'\nfrom = 1.5\nto = 3.0\ncount = 3\n"
      "[[axes]]\nname = 'a'\nfrom = 1.0\nto = 1.1\ncount = 3\n"
      "[integrate]\nsettle = 60\nrecord = 10\n[observe]\nquantities = ['x_max']\n";
  const Scene scene(explored(text), {});
  const StripMaps maps = *compute_strip(scene, {0, 1, 1}, {0, 0}, {});
  const double a = scene.value_at(1, 0.5);
  int resting = 0, moving = 0;
  for (std::size_t cell = 0; cell < kStripCells; ++cell) {
    const double b = scene.value_at(0, cell, 7);
    const double sample = maps.numbers[kStripCells * 2 + cell * maps.samples];
    if (b < 0.8 * (1.0 + a * a)) {
      EXPECT_NEAR(sample, a, 1e-6) << b;
      ++resting;
    } else if (b > 1.2 * (1.0 + a * a)) {
      const double peak = maps.numbers[kStripCells + cell];
      EXPECT_NEAR(sample, peak, 1e-3 * peak) << b;
      ++moving;
    }
  }
  EXPECT_GT(std::min(resting, moving), 20);
}

}  // namespace
}  // namespace gearsweep::testing
