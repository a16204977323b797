// SI units of dimensionless quantities, of studies with a [gear] table.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/trace.hpp"
#include "model/exciting_meshes.hpp"
#include "result/result_file.hpp"
#include "study/study.hpp"

namespace gearsweep {

// How many of the unit `name` one dimensionless unit is; the scale is 0 where there is none.
struct SiUnit {
  double scale = 0.0;
  std::string name;
  std::string axis_meaning = {};  // of an axis in this unit, where it is another than before
};

// As SI has it: m, m/s, rad/s, s, 1/s, N/m, N, W.
SiUnit si_unit(const std::string& unit, const Scales& scales);

// As pictures and tables show it: um, mm/s, N, N/um, and rpm of the pinion for frequencies.
SiUnit shown_unit(const std::string& unit, const Scales& scales);

// What the attributes of a result say of its scales; unknown without a [gear] table. number: the
// attribute of this name, if it is one number.
Scales scales_of(const std::function<std::optional<double>(const std::string& name)>& number);
Scales read_scales(const NetcdfFile& file);
// The meshes that excite, as the file says: one without a name where it tells of no other.
std::vector<ExcitingMesh> read_meshes(const NetcdfFile& file);
// The scales in a file of results, traces or orders; unknown in any other.
Scales scales_in(const std::string& path);

// Throws InputError when the scales are not known; `path`: of the file, for messages.
void ensure_scales(const Scales& scales, const std::string& path);

// Changes values and units of the map and of its axes, which keep their names.
void convert_to_si(const Scales& scales, ResultMap* map);
// The same of a trace's channels; its time stays.
void convert_to_si(const Scales& scales, Trace* trace);

}  // namespace gearsweep
