// The unit that the heading of a measured file names.
#pragma once

#include <span>
#include <string_view>

#include "gear/value_units.hpp"

namespace gearsweep {

class NumberLines;

// By a heading, whose last word may be a unit, alone or in brackets: "share, force (N/mm)". A word
// that is no unit, as in "share, stiffness", says nothing, and so does every word where there are
// no units. heading: its words, without the name of the first column where another follows. Throws
// InputError at the line for a unit of something else, or one that none of these is.
double scale_in_heading(std::span<const ValueUnit> units, std::span<const std::string_view> heading,
                        const NumberLines& lines);

}  // namespace gearsweep
