// SI units of dimensionless quantities, of studies with a [gear] table. Private to this folder.
#pragma once

#include <string>

#include "io/result_file.hpp"
#include "study/study.hpp"

namespace gearsweep {

// How many of the unit `name` one dimensionless unit is; the scale is 0 where there is none.
struct SiUnit {
  double scale = 0.0;
  std::string name;
};

// As files say it: without prefixes, frequencies in rad/s.
SiUnit si_unit(const std::string& unit, const Scales& scales);

// As pictures and tables show it: um, mm/s, N/um, and rpm of the pinion for frequencies.
SiUnit shown_si_unit(const std::string& unit, const Scales& scales);

// Changes values and units of the map and of its axes. Throws InputError when the scales are not
// known; `path`: of the file, for messages.
void convert_to_si(const Scales& scales, const std::string& path, ResultMap* map);

}  // namespace gearsweep
