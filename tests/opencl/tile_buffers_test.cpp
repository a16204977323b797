// How a tile's points lie in the lanes of work-items, and how numbers are packed.
#include "opencl/detail/tile_buffers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "support/bits.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::ElementsAre;

Tile tile_of(std::size_t points, std::vector<std::size_t> grid_starts) {
  Tile tile;
  for (std::size_t i = 0; i < points; ++i) tile.points.push_back(100 + i);
  tile.grid_starts = std::move(grid_starts);
  return tile;
}

// Five points of one phase grid and two of another: spare lanes repeat the last of their own.
TEST(ArrangeSlots, NeverMixesPhaseGridsInOneItem) {
  const Slots slots = arrange_slots(tile_of(7, {0, 5}), 4);
  EXPECT_THAT(slots.position, ElementsAre(0, 1, 2, 3, 4, 4, 4, 4, 5, 6, 6, 6));
  EXPECT_THAT(slots.item_group, ElementsAre(0, 0, 1));
  EXPECT_THAT(slots.slot_of, ElementsAre(0, 1, 2, 3, 4, 8, 9));
}

TEST(ArrangeSlots, OneLanePerItemNeedsNoSpare) {
  const Slots slots = arrange_slots(tile_of(3, {0, 2}), 1);
  EXPECT_THAT(slots.position, ElementsAre(0, 1, 2));
  EXPECT_THAT(slots.item_group, ElementsAre(0, 0, 1));
}

TEST(SpreadStates, PutsEachStateBesideItsNeighbours) {
  const Slots slots = arrange_slots(tile_of(3, {0}), 2);
  // Two states of three points.
  EXPECT_THAT(spread_states({1.0, 10.0, 2.0, 20.0, 3.0, 30.0}, 2, slots),
              ElementsAre(1.0, 2.0, 3.0, 3.0, 10.0, 20.0, 30.0, 30.0));
}

TEST(GridTables, LieOneAfterTheOther) {
  const Plan plan(read_study("[[axes]]\nname = 'eps'\nvalues = [1.4, 1.6]\n[integrate]\n"
                             "steps_per_period = 20\n",
                             "test.toml"),
                  10);
  const GridTables tables = make_grid_tables(plan, {0, 1});
  ASSERT_EQ(tables.grids.size(), 2U);
  const PhaseGrid first = plan.phase_grid_of(0);
  const PhaseGrid second = plan.phase_grid_of(1);
  EXPECT_EQ(tables.grids[0].first_stage, 0U);
  EXPECT_EQ(tables.grids[1].first_segment, first.segment_steps.size());
  EXPECT_EQ(tables.grids[1].first_stage, 2 * first.steps + first.segment_steps.size());
  EXPECT_EQ(tables.coefs.size(), first.coefs.size() + second.coefs.size());
  EXPECT_THAT(tables.steps, ElementsAre(first.steps, second.steps));
}

}  // namespace
}  // namespace gearsweep::testing
