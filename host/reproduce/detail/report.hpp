// The text of `gearsweep reproduce`: claims and verdicts, and what the paper does not ask.
#pragma once

#include <string>

#include "reproduce/detail/measured.hpp"

namespace gearsweep {

// Markdown, all but the pictures.
std::string report_on(const MeasuredFigures& measured);

// The part of it on jumps over the half backlash, and on the basins beside the first of them.
std::string describe_jumps(const MeasuredFigures& measured);

}  // namespace gearsweep
