// A quick coarse picture of a view of which there are no tiles yet.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "explore/scene.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

// A rectangle of the scene's axes, as shares of them.
struct ShareRange {
  std::array<double, 2> from = {0.0, 0.0}, to = {1.0, 1.0};
};

// Throws InputError for a view that is none: 0 <= from < to <= 1.
void require_view(const ShareRange& view);

// Cells beside each other: count[0] columns from cell first[0] on, at one depth.
struct CellBlock {
  std::size_t depth = 0;
  std::array<std::uint64_t, 2> first = {};
  std::array<std::size_t, 2> count = {};
};

// The cells of the deepest depth at which no more than max_points of them touch the view. Throws as
// require_view().
CellBlock cells_in(const ShareRange& view, std::size_t max_points);

struct Preview {
  CellBlock cells;
  std::vector<double> numbers;  // [map][row][column], as compute_cells() has them
  double seconds = 0.0;         // that they took
};

// Nothing when stopped. Throws as compute_cells() does.
std::optional<Preview> compute_preview(const Scene& scene, const CellBlock& cells,
                                       const SweepOptions& options);

}  // namespace gearsweep
