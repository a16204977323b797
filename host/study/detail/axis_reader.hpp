// The [[axes]] of a study.
#pragma once

#include <toml++/toml.h>

#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// One or two axes of distinct parameters or states, their values increasing and in range.
// Throws InputError. `study` is where the axes hang, for messages.
std::vector<Axis> read_axes(const toml::table& study, const Model& model);

}  // namespace gearsweep
