// Every value that a study was computed with, defaults and presets resolved.
#pragma once

#include <string>

#include "study/study.hpp"

namespace gearsweep {

// TOML with [model], [parameters] and [integrate]: what a later version with other presets or
// defaults would need to give the same maps. An axis
// wins over the value of its parameter here.
std::string resolved_settings(const Study& study);

}  // namespace gearsweep
