// The maps of one tile.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "explore/cell_maps.hpp"
#include "explore/scene.hpp"
#include "sweep/sweep_options.hpp"

namespace gearsweep {

struct TileMaps {
  // As CellMaps has them: [map][row][column].
  std::vector<double> numbers;
  std::size_t computed = 0;  // points; the others are the parent's
  double seconds = 0.0;      // that they took
  std::string refusal;       // why the first refused point is; empty: none is
  EngineInfo engine;         // as CellMaps has these, too
  std::vector<std::string> integrated;
};

// Runs the scene's study at the points of a tile (run_sweep()), but for those that its parent has,
// if that is given. Nothing when stopped. A point that the study refuses, such as one whose period
// would need too many steps, is no error. Throws RunError when no device works.
std::optional<TileMaps> compute_tile(const Scene& scene, const TilePlace& place,
                                     const TileMaps* parent, const SweepOptions& options);

// What a tile takes, in bytes.
std::size_t bytes_of(const TileMaps& maps);

}  // namespace gearsweep
