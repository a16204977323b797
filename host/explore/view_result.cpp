#include "explore/view_result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "explore/view_study.hpp"
#include "model/error.hpp"
#include "model/version.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"

namespace gearsweep {
namespace {

constexpr std::size_t kMaxCells = 4096;  // along an axis

// The cells of a depth whose points are in the view.
CellBlock cells_inside(const ShareRange& view, std::size_t depth) {
  CellBlock block{depth, {}, {}};
  const double cells = std::ldexp(1.0, static_cast<int>(depth));
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double first = std::ceil(view.from[axis] * cells);
    const double last = std::min(std::floor(view.to[axis] * cells), cells - 1.0);
    if (last < first + 1.0) throw InputError("there are no two points in the view at this depth");
    const double count = last - first + 1.0;
    if (count > static_cast<double>(kMaxCells)) {
      throw InputError(fmt::format("{} points along an axis; at most {}", count, kMaxCells));
    }
    block.first[axis] = static_cast<std::uint64_t>(first);
    block.count[axis] = static_cast<std::size_t>(count);
  }
  return block;
}

// The study of these cells alone.
Study study_of(const Scene& scene, const CellBlock& cells) {
  std::vector<std::string> axes;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < cells.count[axis]; ++i) {
      values.push_back(scene.value_at(axis, cells.first[axis] + i, cells.depth));
    }
    axes.push_back(fmt::format("{{name = \"{}\", values = [{}]}}", scene.study().axes[axis].name,
                               fmt::join(values, ", ")));
  }
  return study_with_axes(scene, axes);
}

// Puts the numbers of a tile where its cells are in the result.
void take_tile(const TilePlace& place, const TileMaps& maps, const CellBlock& cells,
               SweepResult* result) {
  for (std::size_t i = 0; i < TilePlace::kPoints; ++i) {
    // Cells before the view's first one wrap to numbers beyond all counts.
    const std::uint64_t x =
        place.at[0] * TilePlace::kCells + i % TilePlace::kCells - cells.first[0];
    const std::uint64_t y =
        place.at[1] * TilePlace::kCells + i / TilePlace::kCells - cells.first[1];
    if (x >= cells.count[0] || y >= cells.count[1]) continue;
    if (maps.numbers[i] == kRefused) {
      throw InputError("a part of the view is refused: " + maps.refusal);
    }
    const std::size_t point = y * cells.count[0] + x;
    result->status[point] = static_cast<std::uint8_t>(maps.numbers[i]);
    for (std::size_t map = 0; map < result->values.size(); ++map) {
      result->values[map][point] = maps.numbers[(map + 1) * TilePlace::kPoints + i];
    }
  }
  result->engine = maps.engine;
  result->integrated = maps.integrated;
}

std::string bytes_of_file(const SweepResult& result, const std::string& command_line) {
  const TemporaryFolder folder;
  const std::string path = folder.path() / "view.nc";
  write_result(result, path, {command_line, version(), source_hash()});
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::string view_result(const Scene& scene, const ShareRange& view, std::size_t depth,
                        const FindTile& find_tile, const std::string& command_line) {
  require_view(view);
  const CellBlock cells = cells_inside(view, depth + 5);
  SweepResult result;
  result.study = study_of(scene, cells);
  const std::size_t points = cells.count[0] * cells.count[1];
  result.status.resize(points);
  result.on_orbit.resize(points);
  result.values.assign(result.study.selection.quantities.size(), std::vector<double>(points));
  const auto last = [&](std::size_t axis) {
    return (cells.first[axis] + cells.count[axis] - 1) / TilePlace::kCells;
  };
  for (std::uint64_t j = cells.first[1] / TilePlace::kCells; j <= last(1); ++j) {
    for (std::uint64_t i = cells.first[0] / TilePlace::kCells; i <= last(0); ++i) {
      const TilePlace place = {depth, {i, j}};
      const auto maps = find_tile(place);
      if (maps == nullptr) throw RunError("interrupted");
      take_tile(place, *maps, cells, &result);
    }
  }
  return bytes_of_file(result, command_line);
}

}  // namespace gearsweep
