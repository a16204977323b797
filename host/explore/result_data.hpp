// The numbers of the result file that explore was started with.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

struct ResultData {
  std::array<std::vector<double>, 2> values;  // of its axes
  // [map][y][x]: status, then each quantity of the study, NaN where the file lacks it.
  std::vector<double> numbers;
};

// study: explorable() of the file's own. Nothing where the file has other axes. No other thread may
// be at a NetCDF file meanwhile. Throws as ResultFile does.
std::optional<ResultData> read_result_data(const std::string& path, const Study& study);

}  // namespace gearsweep
