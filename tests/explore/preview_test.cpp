// A quick picture of a view: cells that tiles have, too, as many as are asked for.
#include "explore/preview.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "explore/explored.hpp"
#include "explore/tile_maps.hpp"
#include "model/error.hpp"
#include "support/bits.hpp"

namespace gearsweep::testing {
namespace {

TEST(Preview, HasAsManyCellsAsItMay) {
  const CellBlock cells = cells_in({{0.25, 0.5}, {0.5, 0.75}}, 300);
  EXPECT_EQ(cells.depth, 6U);
  EXPECT_EQ(cells.first[0], 16U);
  EXPECT_EQ(cells.first[1], 32U);
  EXPECT_EQ(cells.count[0], 17U);
  EXPECT_EQ(cells.count[1], 17U);
}

// Also where the view is far smaller than one of its sides, and between cells.
TEST(Preview, NeverHasMoreNorNone) {
  for (const ShareRange& view :
       {ShareRange{}, ShareRange{{0.0, 0.5}, {1.0, 0.5 + 1e-12}},
        ShareRange{{0.3, 0.3}, {0.3 + 1e-15, 0.3 + 1e-15}}, ShareRange{{0.9, 0.0}, {1.0, 1.0}}}) {
    for (const std::size_t most : {48U, 1000U, 4096U}) {
      const CellBlock cells = cells_in(view, most);
      EXPECT_GE(cells.count[0] * cells.count[1], 1U);
      EXPECT_LE(cells.count[0] * cells.count[1], most);
      for (const std::size_t axis : {0U, 1U}) {
        EXPECT_LE(cells.first[axis] + cells.count[axis], std::uint64_t{1} << cells.depth);
      }
    }
  }
  EXPECT_THROW(cells_in({{0.5, 0.0}, {0.5, 1.0}}, 100), InputError);
  EXPECT_THROW(cells_in({{0.5, 0.0}, {std::nan(""), 1.0}}, 100), InputError);
}

TEST(Preview, HasTheBitsOfATile) {
  const Scene scene(explored(), {});
  const TileMaps tile = *compute_tile(scene, {2, {1, 2}}, nullptr, {});
  // Every eighth cell of the tile.
  const Preview preview = *compute_preview(scene, {4, {4, 8}, {4, 4}}, {});
  for (std::size_t map = 0; map < 4; ++map) {
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t column = 0; column < 4; ++column) {
        EXPECT_TRUE(same_bits(preview.numbers[(map * 4 + row) * 4 + column],
                              tile.numbers[(map * 32 + 8 * row) * 32 + 8 * column]));
      }
    }
  }
}

}  // namespace
}  // namespace gearsweep::testing
