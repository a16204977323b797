#include "explore/result_data.hpp"

#include <algorithm>
#include <limits>

#include "result/result_file.hpp"

namespace gearsweep {

std::optional<ResultData> read_result_data(const std::string& path, const Study& study) {
  const ResultFile file(path);
  const std::vector<ResultAxis>& axes = file.axes();
  if (axes.size() != 2) return std::nullopt;
  ResultData data;
  for (std::size_t i = 0; i < 2; ++i) {
    if (axes[i].name != study.axes[i].name || !axes[i].columns.empty()) return std::nullopt;
    data.values[i] = axes[i].values;
  }
  const std::size_t points = axes[0].values.size() * axes[1].values.size();
  data.numbers = file.read("status").values;
  for (const Quantity& quantity : study.selection.quantities) {
    const std::vector<std::string>& known = file.quantities();
    if (std::ranges::find(known, quantity.name) == known.end()) {
      data.numbers.insert(data.numbers.end(), points, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    const std::vector<double> values = file.read(quantity.name).values;
    data.numbers.insert(data.numbers.end(), values.begin(), values.end());
  }
  return data;
}

}  // namespace gearsweep
