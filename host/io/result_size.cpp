#include "io/result_size.hpp"

#include <algorithm>

#include "study/settings.hpp"

namespace gearsweep {

ResultSize size_of_result(const Study& study) {
  constexpr double kVariable = 4096.0;               // its description, and the index of its chunks
  constexpr double kCache = 16.0 * 1024.0 * 1024.0;  // of the NetCDF library, for each variable
  const auto points = static_cast<double>(study.points());
  const double real = study.integrate.fp64 ? 8.0 : 4.0;
  // Each number along a dimension of the quantity's own, or of samples, comes with a coordinate.
  ResultSize size;
  const auto add = [&](double bytes) {
    size.file += kVariable + bytes;
    size.memory += std::min(2.0 * bytes, kCache);
  };
  for (const Axis& axis : study.axes) add(8.0 * static_cast<double>(axis.values.size()));
  add(points);  // status
  double widest = 1.0;
  for (const Quantity& quantity : study.selection.quantities) {
    const bool is_class = !quantity.flags.empty();
    const auto width = static_cast<double>(quantity.width);
    add((is_class ? 1.0 : real) * width * points);
    widest = std::max(widest, width);
    if (quantity.width > 1) add(4.0 * width);
  }
  const auto sampled = static_cast<double>(study.selection.poincare.size());
  const auto record = static_cast<double>(study.integrate.record);
  if (sampled > 0.0) {
    add(real * sampled * record * points);
    add(4.0 * record);
    for (int text = 0; text < 3; ++text) add(64.0 * sampled);
  }
  size.file += static_cast<double>(study.toml.size() + resolved_settings(study).size());
  // Numbers on their way into the file: as the file has them, and packed.
  size.memory += 2.0 * real * widest * points;
  return size;
}

}  // namespace gearsweep
