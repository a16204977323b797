// The units that the values of a measured file may have: its heading names one.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace gearsweep {

// scale: that of a value in what the study counts in, which is the unit of scale 1.
struct ValueUnit {
  std::string_view name;
  double scale = 1.0;
};

inline constexpr std::array kStiffnessUnits = {ValueUnit{"N/m", 1.0}, ValueUnit{"N/mm", 1e3},
                                               ValueUnit{"N/um", 1e6}};
inline constexpr std::array kLengthUnits = {ValueUnit{"um", 1.0}, ValueUnit{"mm", 1e3},
                                            ValueUnit{"m", 1e6}};

class NumberLines;

// Of a heading, whose last word may be a unit, alone or in brackets: "share, force (N/mm)". A word
// that is no unit, as in "share, stiffness", says nothing, and so does every word where there are
// no units. heading: its words, without the name of the first column where another follows. Throws
// InputError at the line for a unit of something else, or one that none of these is.
double scale_in_heading(std::span<const ValueUnit> units, std::span<const std::string_view> heading,
                        const NumberLines& lines);

}  // namespace gearsweep
