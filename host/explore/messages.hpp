// What the explorer's server says: JSON, and records of tiles.
#pragma once

#include <string>
#include <string_view>

#include "explore/explorer.hpp"

namespace gearsweep {

std::string scene_message(const Explorer& explorer, const Scene& scene);
std::string motion_message(const Explorer& explorer, const Motion& motion);
std::string error_message(const std::string& text);

// A record: eight numbers of fp64, little-endian, [kind, depth, i, j, n, points per second,
// seconds, 0], and n numbers. kind 0: a tile, whose numbers are TileMaps::numbers; 1: an error,
// whose numbers are the bytes of its text, zeros behind.
std::string tile_record(const TilePlace& place, const TileMaps& maps, double points_per_second);
std::string error_record(std::string_view text);

}  // namespace gearsweep
