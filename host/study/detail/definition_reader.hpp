// A model's file, parsed as TOML, to its lists of names and expressions.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "equations/definition.hpp"

namespace gearsweep {

// text: of the whole file. source: names it in messages. Throws InputError with the place.
ModelDefinition read_definition(const toml::table& root, const std::string& text,
                                const std::string& source);

}  // namespace gearsweep
