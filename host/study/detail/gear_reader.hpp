// The [gear] table of a study: a drawing, whose errors get their places.
#pragma once

#include <toml++/toml.h>

#include <map>
#include <string>
#include <string_view>

#include "gear/conversion.hpp"

namespace gearsweep {

// The model whose parameters follow from the table.
inline constexpr const char* kGearModel = "gear5";
// Whether it is this one, and no other of the same name.
bool takes_drawing(const Model& model);

// Numbers that stand in place of those of the table, by the names of keys, which axes give.
using GearValues = std::map<std::string, double, std::less<>>;

// What the table says, but for what `values` have. Throws InputError with the place: unknown keys,
// numbers out of range, files whose numbers are none.
GearDrawing read_drawing(const toml::table& gear, const GearValues& values);

// What follows from the drawing that `gear` says. Throws InputError with the place.
GearConversion convert_gear(const GearDrawing& drawing, const Model& model,
                            const toml::table& gear);

// What a message about a key should point at: the key, or the table that lacks it.
const toml::node& node_of(const toml::table& gear, std::string_view key);

}  // namespace gearsweep
