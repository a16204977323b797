// Texts of users as TOML writes them.
#pragma once

#include <string>

namespace gearsweep {

// A text as a basic string of TOML, in double quotes; whatever has a meaning there is escaped.
std::string toml_quoted(const std::string& text);

}  // namespace gearsweep
