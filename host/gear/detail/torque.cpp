#include "gear/detail/torque.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

#include "gear/detail/measured_curve.hpp"

namespace gearsweep {
namespace {

// What swings about its mean, as a force on the base circle in units of k0 b_n.
void add_swing(const GearDrawing& drawing, double mean, double unit, GearTarget* target) {
  std::vector<TablePoint> points = drawing.measured(kTorqueFile)->points;
  const auto [low, high] = std::ranges::minmax(points, {}, &TablePoint::value);
  target->note(
      "torque over a turn: from {:.6g} to {:.6g} N m about a mean of {:.6g} N m{}; the swing turns "
      "the pinion's inertia, so that rho_p of it comes to the teeth",
      low.value, high.value, mean,
      drawing.has(kTorque)
          ? fmt::format(", in place of which torque_N_m is {:.6g}", drawing.required(kTorque))
          : "");
  for (TablePoint& point : points) point.value = (point.value - mean) / unit;
  target->add_curve("torque_swing",
                    std::make_shared<const PeriodicTable>("torque", points, Interpolation::cubic));
}

}  // namespace

double mean_torque(const GearDrawing& drawing) {
  if (drawing.has(kTorque) || !drawing.has(kTorqueFile)) return drawing.required(kTorque);
  return measured_curve(drawing, kTorqueFile, Interpolation::cubic)->mean;
}

void add_torque(const GearDrawing& drawing, const GearBases& bases, GearTarget* target) {
  if (!target->takes(kTorque)) return;
  const double unit = bases.pinion_base * bases.k0 * bases.b_n;
  const double torque = mean_torque(drawing);
  const GearKey& origin = drawing.has(kTorque) ? kTorque : kTorqueFile;
  target->add("F1", torque / unit, origin,
              "T/(Rp k0 b_n) = {:.6g} N m / ({:.6g} m {:.6g} N/m {:.6g} m)", torque,
              bases.pinion_base, bases.k0, bases.b_n);
  const std::optional<MeasuredCurve> curve =
      measured_curve(drawing, kTorqueFile, Interpolation::cubic);
  if (curve) add_swing(drawing, curve->mean, unit, target);
}

}  // namespace gearsweep
