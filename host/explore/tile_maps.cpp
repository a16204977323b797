#include "explore/tile_maps.hpp"

#include <chrono>
#include <limits>

#include "explore/cell_maps.hpp"
#include "explore/detail/pieces.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kCells = TilePlace::kCells, kPoints = TilePlace::kPoints;

std::vector<std::size_t> every(std::size_t first, std::size_t step) {
  std::vector<std::size_t> cells;
  for (std::size_t i = first; i < kCells; i += step) cells.push_back(i);
  return cells;
}

// All cells, or those of which the parent has none: its cells are the even ones of both axes.
std::vector<CellGrid> grids_of(bool has_parent) {
  if (!has_parent) return {{every(0, 1), every(0, 1)}};
  return {{every(1, 2), every(0, 1)}, {every(0, 2), every(1, 2)}};
}

class Filling {
 public:
  Filling(const Scene& scene, const TilePlace& place)
      : scene_(scene), place_(place), maps_(1 + scene.study().selection.quantities.size()) {
    out_.numbers.resize(maps_ * kPoints, std::numeric_limits<double>::quiet_NaN());
  }

  void take_from(const TileMaps& parent) {
    const std::size_t left = place_.at[0] % 2 * kCells / 2, below = place_.at[1] % 2 * kCells / 2;
    for (std::size_t map = 0; map < maps_; ++map) {
      for (std::size_t row = 0; row < kCells; row += 2) {
        for (std::size_t column = 0; column < kCells; column += 2) {
          at(map, row, column) =
              parent.numbers[map * kPoints + (below + row / 2) * kCells + left + column / 2];
        }
      }
    }
  }

  // False when stopped.
  bool compute(const CellGrid& grid, const SweepOptions& options) {
    std::optional<CellMaps> cells = compute_cells(scene_, values_of(grid), options);
    if (!cells) return false;
    auto number = cells->numbers.begin();
    for (std::size_t map = 0; map < maps_; ++map) {
      for (const std::size_t row : grid[1]) {
        for (const std::size_t column : grid[0]) at(map, row, column) = *number++;
      }
    }
    if (out_.refusal.empty()) out_.refusal = cells->refusal;
    out_.engine = std::move(cells->engine);
    out_.integrated = std::move(cells->integrated);
    out_.computed += grid[0].size() * grid[1].size();
    return true;
  }

  TileMaps take(double seconds) {
    out_.seconds = seconds;
    return std::move(out_);
  }

 private:
  double& at(std::size_t map, std::size_t row, std::size_t column) {
    return out_.numbers[map * kPoints + row * kCells + column];
  }
  std::array<std::vector<double>, 2> values_of(const CellGrid& grid) const {
    std::array<std::vector<double>, 2> values;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (const std::size_t cell : grid[axis]) {
        values[axis].push_back(
            scene_.value_at(axis, place_.at[axis] * kCells + cell, place_.depth + 5));
      }
    }
    return values;
  }

  const Scene& scene_;
  const TilePlace place_;
  const std::size_t maps_;
  TileMaps out_;
};

}  // namespace

std::optional<TileMaps> compute_tile(const Scene& scene, const TilePlace& place,
                                     const TileMaps* parent, const SweepOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  // What a parent has of refused points may be a guess.
  if (parent != nullptr && !parent->refusal.empty()) parent = nullptr;
  Filling tile(scene, place);
  if (parent != nullptr) tile.take_from(*parent);
  for (const CellGrid& grid : grids_of(parent != nullptr)) {
    if (!tile.compute(grid, options)) return std::nullopt;
  }
  return tile.take(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

std::size_t bytes_of(const TileMaps& maps) { return maps.numbers.size() * sizeof(double); }

}  // namespace gearsweep
