// The points of a view as a result file.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "explore/preview.hpp"
#include "explore/scene.hpp"
#include "explore/tile_maps.hpp"

namespace gearsweep {

// The tiles of one depth, asked for one by one; null: stopped.
using FindTile = std::function<std::shared_ptr<const TileMaps>(const TilePlace& place)>;

// A NetCDF file as 'gearsweep run' writes it, with the cells of this depth of tiles whose points
// are in the view: its axes are lists of their values. command_line: what the file says that it is
// from. No two threads may be at a NetCDF file at once. Throws InputError for a view that is none,
// has too many points, or has refused ones; RunError when stopped.
std::string view_result(const Scene& scene, const ShareRange& view, std::size_t depth,
                        const FindTile& find_tile, const std::string& command_line);

}  // namespace gearsweep
