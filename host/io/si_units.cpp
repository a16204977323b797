#include "io/si_units.hpp"

#include <fmt/format.h>

#include "model/error.hpp"

namespace gearsweep {

SiUnit si_unit(const std::string& unit, const Scales& scales) {
  if (!scales.known()) return {};
  if (unit == "b_n") return {scales.b_n, "m"};
  if (unit == "b_n varpi") return {scales.b_n * scales.varpi, "m/s"};
  if (unit == "varpi") return {scales.varpi, "rad/s"};
  if (unit == "1/tau") return {scales.varpi, "1/s"};
  if (unit == "k0") return {scales.k0, "N/m"};
  if (unit == "k0 b_n") return {scales.k0 * scales.b_n, "N"};
  return {};
}

SiUnit shown_si_unit(const std::string& unit, const Scales& scales) {
  if (unit == "varpi" && scales.rpm_per_omega > 0.0) return {scales.rpm_per_omega, "rpm"};
  const SiUnit plain = si_unit(unit, scales);
  if (plain.name == "m") return {1e6 * plain.scale, "µm"};
  if (plain.name == "m/s") return {1e3 * plain.scale, "mm/s"};
  if (plain.name == "N/m") return {1e-6 * plain.scale, "N/µm"};
  return plain;
}

void convert_to_si(const Scales& scales, const std::string& path, ResultMap* map) {
  if (!scales.known()) {
    throw InputError(
        fmt::format("--units SI: '{}' has no scales; a study with a [gear] table has them", path));
  }
  for (ResultAxis& axis : map->axes) {
    const SiUnit si = shown_si_unit(axis.unit, scales);
    if (si.scale <= 0.0) continue;
    for (double& value : axis.values) value *= si.scale;
    if (si.name == "rpm") {
      axis.meaning = "pinion speed";
      axis.name.clear();
    }
    axis.unit = si.name;
  }
  // The samples of each part of each point stand beside each other.
  const std::size_t parts = map->part_count();
  for (std::size_t part = 0; part < parts; ++part) {
    const SiUnit si = shown_si_unit(map->parts.empty() ? map->unit : map->parts[part].unit, scales);
    if (si.scale <= 0.0) continue;
    for (std::size_t point = 0; point < map->points(); ++point) {
      double* first = map->values.data() + (point * parts + part) * map->samples;
      for (double* value = first; value < first + map->samples; ++value) *value *= si.scale;
    }
    if (!map->parts.empty()) map->parts[part].unit = si.name;
  }
  const SiUnit own = shown_si_unit(map->unit, scales);
  if (own.scale > 0.0) map->unit = own.name;
}

}  // namespace gearsweep
