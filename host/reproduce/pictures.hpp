// Draws what `gearsweep reproduce` has measured. Private to this folder.
#pragma once

#include <string>

#include "reproduce/measured.hpp"

namespace gearsweep {

// Draws from the results in `folder`, and returns the Markdown that shows the pictures. Throws
// RunError.
std::string draw_pictures(const Measured& measured, const std::string& folder);

}  // namespace gearsweep
