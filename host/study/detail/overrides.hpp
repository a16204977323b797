// Overrides of single keys of a study: "--set path=value".
#pragma once

#include <toml++/toml.h>

#include <string>

namespace gearsweep {

// Sets one key of a study's table: "integrate.record=20", "model.preset=paper" (a bare word is a
// string), "axes.omega.count=40" (an axis by its name or its number from 0). Tables that are
// missing on the way are made. Throws InputError.
void apply_override(const std::string& assignment, toml::table* study);

}  // namespace gearsweep
