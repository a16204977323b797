#include "rexs/detail/tooth_play.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gearsweep {
namespace {

double inv(double angle) { return std::tan(angle) - angle; }

}  // namespace

double StageGeometry::transverse_alpha() const {
  return std::atan(std::tan(alpha) / std::cos(helix));
}

double StageGeometry::working_alpha() const {
  const double reference = 0.5 * module / std::cos(helix) * teeth;
  return std::acos(reference * std::cos(transverse_alpha()) / centre);
}

double StageGeometry::base_helix() const { return std::asin(std::sin(helix) * std::cos(alpha)); }

std::optional<double> shifts_without_play(const StageGeometry& geometry) {
  const double working = geometry.working_alpha();
  if (!(working > 0.0)) return std::nullopt;
  return (inv(working) - inv(geometry.transverse_alpha())) * geometry.teeth /
         (2.0 * std::tan(geometry.alpha));
}

// Normal play is that along the line of action times cos(beta_b), play on the working circles that
// over cos(alpha_w).
std::optional<ToothPlay> tooth_play(const UnitStage& stage,
                                    const std::array<const UnitGear*, 2>& gears,
                                    const StageGeometry& geometry) {
  const double slope = std::cos(geometry.base_helix());
  if (stage.backlash && *stage.backlash > 0.0) {
    return ToothPlay{*stage.backlash / slope,
                     "from the file: half the mean of its normal backlash"};
  }
  if (stage.transverse_backlash && *stage.transverse_backlash > 0.0 && geometry.centre > 0.0) {
    return ToothPlay{*stage.transverse_backlash * std::cos(geometry.working_alpha()),
                     "from the file: half the mean of its transverse backlash"};
  }
  if (!gears[0]->thinned || !gears[1]->thinned) return std::nullopt;
  const auto fitting = shifts_without_play(geometry);
  if (!fitting) return std::nullopt;
  const double thinned = *gears[0]->thinned + *gears[1]->thinned;
  const double left =
      2.0 * geometry.module * std::sin(geometry.alpha) * (*fitting - geometry.shifts);
  const double along = (thinned + left) / slope;
  if (!(along > 0.0)) return std::nullopt;
  return ToothPlay{
      along,
      fmt::format("computed: half of what {} thins both gears' teeth by, {:.4g} mm along the "
                  "normal, and of {:.4g} mm that the centre distance leaves",
                  gears[0]->thinned_by, thinned, left)};
}

}  // namespace gearsweep
