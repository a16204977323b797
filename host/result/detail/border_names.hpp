// What files of border curves call their parts.
#pragma once

#include <string>

namespace gearsweep {

inline constexpr const char* kContentOfBorders = "border curves of gearsweep";

// The variable of a parameter: one with the name of something else in the file gives way.
std::string variable_of(const std::string& parameter);

}  // namespace gearsweep
