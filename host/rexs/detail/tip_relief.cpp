#include "rexs/detail/tip_relief.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace gearsweep {
namespace {

// Along the line of action, in mm from where it touches the gear's base circle.
double way_at(double diameter, double base) {
  return std::sqrt(0.25 * diameter * diameter - base * base);
}

struct Involute {
  double base = 0.0, tip = 0.0;  // radius; way of the tip
};

// In the transverse section.
Involute involute_of(const UnitGear& gear, const StageGeometry& geometry) {
  const double reference = geometry.module * *gear.teeth / std::cos(geometry.helix);
  const double usual = reference + 2.0 * geometry.module * (1.0 + gear.shift.value_or(0.0));
  const double base = 0.5 * reference * std::cos(geometry.transverse_alpha());
  const double tip = gear.tip_diameter ? *gear.tip_diameter
                     : gear.addendum   ? usual + 2.0 * (*gear.addendum - geometry.module)
                                       : usual;
  return {base, way_at(tip, base)};
}

// Where a relief begins, as a way before the tip.
double way_of(const TipRelief& relief, const Involute& flank) {
  return relief.diameter ? flank.tip - way_at(*relief.diameter, flank.base) : *relief.length;
}

}  // namespace

std::optional<std::string> tip_relief_table(const std::array<const UnitGear*, 2>& gears,
                                            const StageGeometry& geometry) {
  constexpr int kPieces = 8;  // of a parabola
  const double working =
      geometry.centre > 0.0 ? geometry.working_alpha() : geometry.transverse_alpha();
  const Involute flanks[2] = {involute_of(*gears[0], geometry), involute_of(*gears[1], geometry)};
  const double path =
      flanks[0].tip + flanks[1].tip - (flanks[0].base + flanks[1].base) * std::tan(working);
  std::vector<std::pair<double, double>> points;  // share, um
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& relief = gears[i]->tip_relief;
    if (!relief) {
      points.emplace_back(i == 0 ? 1.0 : 0.0, 0.0);
      continue;
    }
    const double way = way_of(*relief, flanks[i]) / path;
    if (!(way > 0.0 && way < 0.5)) return std::nullopt;
    const int pieces = relief->is_parabolic ? kPieces : 1;
    for (int k = 0; k <= pieces; ++k) {
      const double u = static_cast<double>(k) / pieces;
      const double depth = 1e3 * relief->depth * (relief->is_parabolic ? u * u : u);
      const double before = way * (1.0 - u);
      points.emplace_back(i == 0 ? 1.0 - before : before, depth);
    }
  }
  std::ranges::sort(points);
  std::string table = "share, um\n";
  for (const auto& [share, depth] : points) table += fmt::format("{:.6f}, {:.6g}\n", share, depth);
  return table;
}

}  // namespace gearsweep
