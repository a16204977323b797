#include "explore/cell_maps.hpp"

#include <limits>
#include <numeric>

#include "explore/detail/pieces.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep {

std::optional<CellMaps> compute_cells(const Scene& scene,
                                      const std::array<std::vector<double>, 2>& values,
                                      const SweepOptions& options) {
  const std::size_t columns = values[0].size(), points = columns * values[1].size();
  const std::size_t maps = 1 + scene.study().selection.quantities.size();
  CellMaps out;
  out.numbers.assign(maps * points, std::numeric_limits<double>::quiet_NaN());
  CellGrid all;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    all[axis].resize(values[axis].size());
    std::iota(all[axis].begin(), all[axis].end(), std::size_t{0});
  }
  const auto compute = [&](const CellGrid& grid) {
    std::array<std::vector<double>, 2> part;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      for (const std::size_t cell : grid[axis]) part[axis].push_back(values[axis][cell]);
    }
    const std::optional<SweepResult> result = run_sweep(scene.at(part), options);
    if (!result) return false;
    std::size_t point = 0;
    for (const std::size_t row : grid[1]) {
      for (const std::size_t column : grid[0]) {
        const std::size_t to = row * columns + column;
        out.numbers[to] = result->status[point];
        for (std::size_t map = 1; map < maps; ++map) {
          out.numbers[map * points + to] = result->values[map - 1][point];
        }
        ++point;
      }
    }
    out.engine = result->engine;
    out.integrated = result->integrated;
    return true;
  };
  const auto refuse = [&](const CellGrid& grid, const std::string& why) {
    if (out.refusal.empty()) out.refusal = why;
    for (const std::size_t row : grid[1]) {
      for (const std::size_t column : grid[0]) out.numbers[row * columns + column] = kRefused;
    }
  };
  if (!compute_in_pieces(all, compute, refuse)) return std::nullopt;
  return out;
}

}  // namespace gearsweep
