// [gear] in a study: drawings, whose errors get their places.
#pragma once

#include <toml++/toml.h>

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gear/conversion.hpp"

namespace gearsweep {

// The key of a drawing's table with the names of its keys whose values are guesses.
inline constexpr std::string_view kEstimated = "estimated";

// The table of a drawing: [gear] itself, or [gear.first] of a model with the drawing `first`.
struct DrawingTable {
  std::string heading;                 // as messages name it
  std::string suffix;                  // of names in the model: "", or "_first"
  const toml::table* table = nullptr;  // nullptr where the study has none
};

// Those that a study of the model may have. Throws InputError for what [gear] has besides.
std::vector<DrawingTable> drawing_tables(const toml::table& study, const Model& model);

// What one of a pair is called where it varies alone: pinion_runout_um, gear_runout_um.
std::string member_name(const GearKey& key, std::size_t member);

// Numbers that stand in place of those of a table, by the names of keys, which axes give.
using GearValues = std::map<std::string, double, std::less<>>;

// What a table says, but for what `values` have. Throws InputError with the place: unknown keys,
// numbers out of range, files whose numbers are none.
GearDrawing read_drawing(const DrawingTable& from, const GearValues& values);

// What follows from the drawing that the table says. Throws InputError with the place.
GearConversion convert_gear(const GearDrawing& drawing, const Model& model,
                            const DrawingTable& from, GearTexts texts = GearTexts::all);

// What a message about a key should point at: the key, or the table that lacks it.
const toml::node& node_of(const DrawingTable& from, std::string_view key);

}  // namespace gearsweep
