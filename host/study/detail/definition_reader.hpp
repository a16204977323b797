// A model's file, parsed as TOML, to its lists of names and expressions.
#pragma once

#include <toml++/toml.h>

#include <set>
#include <string>

#include "equations/definition.hpp"

namespace gearsweep {

// text: of the whole file. source: names it in messages. promoted: constants that are to be
// parameters, where they are plain numbers; other names change nothing. Throws InputError with the
// place.
ModelDefinition read_definition(const toml::table& root, const std::string& text,
                                const std::string& source, const std::set<std::string>& promoted);

}  // namespace gearsweep
