// [sections] of a model's file, or of a study.
#pragma once

#include <toml++/toml.h>

#include <vector>

#include "equations/definition.hpp"

namespace gearsweep {

// In the order of the file; none where there is no table. Throws InputError with the place.
std::vector<SectionDefinition> read_sections(const toml::table* table);

}  // namespace gearsweep
