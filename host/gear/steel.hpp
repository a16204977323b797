// The material of gears whose drawing names none.
#pragma once

namespace gearsweep {

inline constexpr double kSteel = 7.85e-6;  // density, kg/mm^3

}  // namespace gearsweep
