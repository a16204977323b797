#include "result/si_units.hpp"

#include <fmt/format.h>

#include <cmath>

#include "model/error.hpp"
#include "result/detail/file_names.hpp"
#include "result/detail/netcdf_file.hpp"

namespace gearsweep {

SiUnit si_unit(const std::string& unit, const Scales& scales) {
  if (!scales.known()) return {};
  if (unit == "b_n") return {scales.b_n, "m"};
  if (unit == "b_n varpi") return {scales.b_n * scales.varpi, "m/s"};
  if (unit == "varpi") return {scales.varpi, "rad/s"};
  if (unit == "1/varpi") return {1.0 / scales.varpi, "s"};
  if (unit == "1/tau") return {scales.varpi, "1/s"};
  if (unit == "tau") return {1.0 / scales.varpi, "s"};
  if (unit == "k0") return {scales.k0, "N/m"};
  if (unit == "k0 b_n") return {scales.k0 * scales.b_n, "N"};
  if (unit == "k0 b_n^2 varpi") {
    return {scales.k0 * scales.b_n * scales.b_n * scales.varpi, "W"};
  }
  return {};
}

SiUnit shown_unit(const std::string& unit, const Scales& scales) {
  const SiUnit si = si_unit(unit, scales);
  if (si.name == "m") return {1e6 * si.scale, "µm"};
  if (si.name == "m/s") return {1e3 * si.scale, "mm/s"};
  if (si.name == "N/m") return {1e-6 * si.scale, "N/µm"};
  if (si.name == "rad/s" && scales.rpm_per_omega > 0.0)
    return {scales.rpm_per_omega, "rpm", "pinion speed"};
  return si;
}

Scales scales_of(const std::function<std::optional<double>(const std::string& name)>& number) {
  const auto scale = [&](const char* name) {
    const double value = number(name).value_or(0.0);
    return std::isfinite(value) && value > 0.0 ? value : 0.0;
  };
  Scales scales;
  scales.varpi = scale("scale_varpi_rad_per_s");
  scales.b_n = scale("scale_b_n_m");
  scales.k0 = scale("scale_k0_N_per_m");
  scales.rpm_per_omega = scale("scale_rpm_per_omega");
  return scales;
}

Scales read_scales(const NetcdfFile& file) {
  return scales_of([&](const std::string& name) -> std::optional<double> {
    const std::vector<double> numbers = file.number_attribute(NC_GLOBAL, name);
    return numbers.size() == 1 ? std::optional(numbers.front()) : std::nullopt;
  });
}

std::vector<ExcitingMesh> read_meshes(const NetcdfFile& file) {
  const std::string name = file.text_attribute(NC_GLOBAL, kOtherMesh).value_or("");
  const std::vector<double> order = file.number_attribute(NC_GLOBAL, kOtherMeshOrder);
  if (name.empty() || order.size() != 1 || !(order.front() > 0.0)) return {{}};
  const std::string first = file.text_attribute(NC_GLOBAL, kMeshOfPhase).value_or("");
  return {{first, 1.0}, {name, order.front()}};
}

Scales scales_in(const std::string& path) {
  return is_netcdf(path) ? read_scales(NetcdfFile::open(path)) : Scales{};
}

void ensure_scales(const Scales& scales, const std::string& path) {
  if (scales.known()) return;
  throw InputError(
      fmt::format("--units SI: '{}' has no scales; a study with a [gear] table has them", path));
}

void convert_to_si(const Scales& scales, Trace* trace) {
  for (std::size_t i = 0; i < trace->channels.size(); ++i) {
    const SiUnit si = shown_unit(trace->channels[i].unit, scales);
    if (si.scale <= 0.0) continue;
    for (double& value : trace->values[i]) value *= si.scale;
    trace->channels[i].unit = si.name;
  }
}

namespace {

void convert_axis(const Scales& scales, ResultAxis* axis) {
  for (ResultAxis& column : axis->columns) convert_axis(scales, &column);
  const SiUnit si = shown_unit(axis->unit, scales);
  if (si.scale <= 0.0) return;
  for (double& value : axis->values) value *= si.scale;
  if (!si.axis_meaning.empty()) axis->meaning = si.axis_meaning;
  axis->unit = si.name;
}

}  // namespace

void convert_to_si(const Scales& scales, ResultMap* map) {
  for (ResultAxis& axis : map->axes) convert_axis(scales, &axis);
  // The samples of each part of each point stand beside each other.
  const std::size_t parts = map->part_count();
  for (std::size_t part = 0; part < parts; ++part) {
    const SiUnit si = shown_unit(map->parts.empty() ? map->unit : map->parts[part].unit, scales);
    if (si.scale <= 0.0) continue;
    for (std::size_t point = 0; point < map->points(); ++point) {
      double* first = map->values.data() + (point * parts + part) * map->samples;
      for (double* value = first; value < first + map->samples; ++value) *value *= si.scale;
    }
    if (!map->parts.empty()) map->parts[part].unit = si.name;
  }
  const SiUnit own = shown_unit(map->unit, scales);
  if (own.scale > 0.0) map->unit = own.name;
}

}  // namespace gearsweep
