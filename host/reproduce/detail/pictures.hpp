// Plots what `gearsweep reproduce` has measured.
#pragma once

#include <string>

#include "reproduce/detail/measured.hpp"

namespace gearsweep {

// Plots from the results in `folder`, and returns the Markdown that shows the pictures. Throws
// RunError.
std::string plot_pictures(const MeasuredFigures& measured, const std::string& folder);

}  // namespace gearsweep
