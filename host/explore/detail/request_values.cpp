#include "explore/detail/request_values.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace gearsweep {
namespace {

constexpr std::size_t kMaxTiles = 512;    // of a request
constexpr std::size_t kMaxStrips = 128;   // of a request
constexpr std::size_t kMaxChanges = 256;  // of a scene

// "mu=0.1"
NamedValue read_change(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw Refusal{400, "set takes NAME=NUMBER, with %3D for the '='"};
  }
  const std::string name = text.substr(0, equals);
  return {name, read_number<double>(name, text.substr(equals + 1))};
}

void refuse_too_many(const nlohmann::json& list, std::size_t max, const char* what) {
  if (list.size() <= max) return;
  throw Refusal{400, fmt::format("{} {}; at most {} at once", list.size(), what, max)};
}

// A double would be cast, which is undefined beyond the type's ends.
std::uint64_t whole(const nlohmann::json& number) {
  if (!number.is_number_unsigned()) throw Refusal{400, "a place is told by whole numbers"};
  return number.get<std::uint64_t>();
}

bool is_cell(std::uint64_t k, std::size_t depth) {
  return depth <= Cell::kMaxDepth && k <= std::uint64_t{1} << depth;
}

}  // namespace

SceneChanges changes_of(const httplib::Request& request) {
  SceneChanges changes = {{}, request.get_param_value("x"), request.get_param_value("y")};
  const std::size_t count = request.get_param_value_count("set");
  if (count > kMaxChanges) throw Refusal{400, "too many changes"};
  for (std::size_t i = 0; i < count; ++i) {
    changes.sets.push_back(read_change(request.get_param_value("set", i)));
  }
  return changes;
}

ShareRange shares_of(const httplib::Request& request) {
  return {{number_of(request, "x0", 0.0), number_of(request, "y0", 0.0)},
          {number_of(request, "x1", 1.0), number_of(request, "y1", 1.0)}};
}

Cell cell_of(const httplib::Request& request) {
  const Cell cell = {
      number_of<std::size_t>(request, "depth", 0),
      {number_of<std::uint64_t>(request, "kx", 0), number_of<std::uint64_t>(request, "ky", 0)}};
  if (!is_cell(cell.k[0], cell.depth) || !is_cell(cell.k[1], cell.depth)) {
    throw Refusal{400, "a cell that is not there"};
  }
  return cell;
}

std::vector<TilePlace> read_places(const nlohmann::json& list) {
  refuse_too_many(list, kMaxTiles, "tiles");
  std::vector<TilePlace> places;
  for (const nlohmann::json& one : list) {
    const TilePlace place = {whole(one.at(0)), {whole(one.at(1)), whole(one.at(2))}};
    const bool is_there = place.depth <= TilePlace::kMaxDepth && place.at[0] >> place.depth == 0 &&
                          place.at[1] >> place.depth == 0;
    if (!is_there) throw Refusal{400, "a tile that is not there"};
    places.push_back(place);
  }
  return places;
}

ShareRange read_view(const nlohmann::json& list) {
  const auto share = [&](std::size_t i) { return list.at(i).get<double>(); };
  return {{share(0), share(1)}, {share(2), share(3)}};
}

Line read_line(const nlohmann::json& body) {
  const Line line = {whole(body.at("axis")), whole(body.at("at").at(0)),
                     whole(body.at("at").at(1))};
  if (line.axis > 1 || !is_cell(line.k, line.depth)) {
    throw Refusal{400, "a line that is not there"};
  }
  return line;
}

std::vector<Strip> read_strips(const nlohmann::json& list) {
  refuse_too_many(list, kMaxStrips, "strips");
  std::vector<Strip> strips;
  for (const nlohmann::json& one : list) {
    const Strip strip = {whole(one.at(0)), whole(one.at(1))};
    if (!strip.is_there()) throw Refusal{400, "a strip that is not there"};
    strips.push_back(strip);
  }
  return strips;
}

}  // namespace gearsweep
