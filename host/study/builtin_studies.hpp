// The built-in studies, embedded in the binary.
#pragma once

#include <map>
#include <string>

namespace gearsweep {

// TOML text by file name, as in "coarse-map.toml".
const std::map<std::string, std::string>& builtin_studies();

}  // namespace gearsweep
