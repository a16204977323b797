// What the explorer's server says: JSON, and records of tiles.
#pragma once

#include <string>
#include <string_view>

#include "explore/explorer.hpp"

namespace gearsweep {

std::string scene_message(const Explorer& explorer, const Scene& scene);
std::string motion_message(const Explorer& explorer, const Scene& scene, const Motion& motion);
std::string orbit_message(const MotionOrbit& orbit);
std::string starts_message(const Scene& scene, const ReachedAttractors& reached,
                           std::size_t starts);
std::string error_message(const std::string& text);

// A record: eight numbers of fp64, little-endian, of which the first is its kind and the fifth n,
// and n numbers more.
// [0, depth, i, j, n, points per second, seconds, 0]: a tile, TileMaps::numbers.
std::string tile_record(const TilePlace& place, const TileMaps& maps, double points_per_second);
// [1, 0, 0, 0, n, 0, 0, 0]: an error, the bytes of its text with zeros behind.
std::string error_record(std::string_view text);
// [2, depth, first column, first row, n, points per second, seconds, columns]: Preview::numbers.
std::string preview_record(const Preview& preview, double points_per_second);
// [3, depth, at, axis, n, points per second, seconds, samples]: StripMaps::numbers.
std::string strip_record(const Line& line, const Strip& strip, const StripMaps& maps,
                         double points_per_second);
// [4, 0, 0, 0, n, columns, rows, 0]: the share of each column and of each row on the scene's axes,
// their values, then ResultData::numbers.
std::string data_record(const Scene& scene, const ResultData& data);

}  // namespace gearsweep
