// Work on a grid of cells of which the study refuses some points.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "model/error.hpp"

namespace gearsweep {

// Columns and rows of cells that are computed together.
using CellGrid = std::array<std::vector<std::size_t>, 2>;

namespace detail {

inline CellGrid part_of(const CellGrid& grid, std::size_t axis, bool is_second) {
  CellGrid part = grid;
  const auto middle = grid[axis].begin() + static_cast<std::ptrdiff_t>(grid[axis].size() / 2);
  part[axis].assign(is_second ? middle : grid[axis].begin(), is_second ? grid[axis].end() : middle);
  return part;
}

// Up to 25 cells all over the grid.
inline std::vector<CellGrid> probes_of(const CellGrid& grid) {
  constexpr std::size_t kAlong = 4;  // steps
  std::vector<CellGrid> probes;
  const auto at = [&](std::size_t axis, std::size_t i) {
    return grid[axis][i * (grid[axis].size() - 1) / kAlong];
  };
  for (std::size_t j = 0; j <= kAlong; ++j) {
    for (std::size_t i = 0; i <= kAlong; ++i) probes.push_back({{{at(0, i)}, {at(1, j)}}});
  }
  return probes;
}

}  // namespace detail

// Calls compute(grid), and where that throws InputError its halves, down to single cells, of which
// refuse(grid, why) is told. Where 25 cells all over the grid are refused, all of it is taken to
// be. compute returns false when stopped, as this then does.
template <typename Compute, typename Refuse>
bool compute_in_pieces(const CellGrid& grid, const Compute& compute, const Refuse& refuse) {
  std::string why;
  try {
    return compute(grid);
  } catch (const InputError& error) {
    why = error.what();
  }
  const std::size_t cells = grid[0].size() * grid[1].size();
  const auto is_refused = [&](const CellGrid& probe) {
    try {
      compute(probe);
      return false;
    } catch (const InputError&) {
      return true;
    }
  };
  constexpr std::size_t kFew = 64;
  const bool is_all =
      cells == 1 || (cells > kFew && std::ranges::all_of(detail::probes_of(grid), is_refused));
  if (is_all) {
    refuse(grid, why);
    return true;
  }
  const std::size_t axis = grid[0].size() >= grid[1].size() ? 0 : 1;
  for (const bool is_second : {false, true}) {
    if (!compute_in_pieces(detail::part_of(grid, axis, is_second), compute, refuse)) return false;
  }
  return true;
}

}  // namespace gearsweep
