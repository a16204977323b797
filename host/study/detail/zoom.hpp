// Another stretch of an axis, "--zoom AXIS=FROM:TO".
#pragma once

#include <toml++/toml.h>

#include <string>

namespace gearsweep {

// Gives an axis of a study's table new ends and, as in "omega=1.5:1.9:400", another count; without
// it the axis keeps as many values as it has. A list of values gives way to evenly spaced ones.
// Throws InputError.
void apply_zoom(const std::string& zoom, toml::table* study);

}  // namespace gearsweep
