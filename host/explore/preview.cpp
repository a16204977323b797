#include "explore/preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "explore/cell_maps.hpp"
#include "model/error.hpp"

namespace gearsweep {
namespace {

// The cells of a depth that touch the part of an axis between two shares. A cell reaches half a
// cell to each side of its point; share 1 belongs to no cell.
void place(double from, double to, std::size_t depth, std::size_t axis, CellBlock* block) {
  const double cells = std::ldexp(1.0, static_cast<int>(depth));
  const auto cell = [&](double share) {
    return std::min(std::floor(share * cells + 0.5), cells - 1);
  };
  block->first[axis] = static_cast<std::uint64_t>(cell(from));
  block->count[axis] = static_cast<std::size_t>(cell(to) - cell(from)) + 1;
}

CellBlock cells_at(const ShareRange& view, std::size_t depth) {
  CellBlock block{depth, {}, {}};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    place(view.from[axis], view.to[axis], depth, axis, &block);
  }
  return block;
}

}  // namespace

void require_view(const ShareRange& view) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double from = view.from[axis], to = view.to[axis];
    if (0.0 <= from && from < to && to <= 1.0) continue;
    throw InputError(fmt::format("a view from {} to {} is none: 0 <= from < to <= 1", from, to));
  }
}

CellBlock cells_in(const ShareRange& view, std::size_t max_points) {
  require_view(view);
  CellBlock block = cells_at(view, 0);
  for (std::size_t depth = 1; depth <= Cell::kMaxDepth; ++depth) {
    const CellBlock finer = cells_at(view, depth);
    if (finer.count[0] > max_points || finer.count[0] * finer.count[1] > max_points) break;
    block = finer;
  }
  return block;
}

std::optional<Preview> compute_preview(const Scene& scene, const CellBlock& cells,
                                       const SweepOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  std::array<std::vector<double>, 2> values;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    for (std::size_t i = 0; i < cells.count[axis]; ++i) {
      values[axis].push_back(scene.value_at(axis, cells.first[axis] + i, cells.depth));
    }
  }
  std::optional<CellMaps> maps = compute_cells(scene, values, options);
  if (!maps) return std::nullopt;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  return Preview{cells, std::move(maps->numbers), taken.count()};
}

}  // namespace gearsweep
