// The presets of a model's file.
#pragma once

#include <toml++/toml.h>

#include "equations/definition.hpp"

namespace gearsweep {

// Takes [presets] into a definition whose states, parameters and options are read. The values of
// the file are a preset, too: the first one of the file, if that changes nothing. table: null where
// there is none. Throws InputError.
void read_presets(const toml::table* table, ModelDefinition* definition);

}  // namespace gearsweep
