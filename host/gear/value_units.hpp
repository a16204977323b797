// The units that measured values of a gear pair may have.
#pragma once

#include <array>
#include <string_view>

namespace gearsweep {

// scale: that of a value in what the program counts in, which is the unit of scale 1.
struct ValueUnit {
  std::string_view name;
  double scale = 1.0;
};

inline constexpr std::array kStiffnessUnits = {ValueUnit{"N/m", 1.0}, ValueUnit{"N/mm", 1e3},
                                               ValueUnit{"N/um", 1e6}};
inline constexpr std::array kLengthUnits = {ValueUnit{"um", 1.0}, ValueUnit{"mm", 1e3},
                                            ValueUnit{"m", 1e6}};
inline constexpr std::array kTorqueUnits = {ValueUnit{"N m", 1.0}, ValueUnit{"kN m", 1e3},
                                            ValueUnit{"N mm", 1e-3}};

}  // namespace gearsweep
