#include "gear/detail/faults.hpp"

#include <fmt/format.h>

#include <array>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

namespace gearsweep {
namespace {

// nullptr where there are none.
const std::vector<double>* pitch_errors(const GearDrawing& drawing, const GearKey& key,
                                        double teeth) {
  const Measured* measured = drawing.measured(key);
  if (measured == nullptr) return nullptr;
  if (static_cast<double>(measured->teeth.size()) != teeth) {
    throw DrawingError(key,
                       fmt::format("'{}' has {} numbers; it needs one for each of the {} teeth",
                                   measured->source, measured->teeth.size(), teeth));
  }
  return &measured->teeth;
}

// A spline through the errors of the teeth, where each enters, and its second derivative.
void add_pitch_errors(const std::string& gear, const std::vector<double>& errors, double b_n,
                      GearTarget* target) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  std::vector<TablePoint> points;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    points.push_back({kTurn * static_cast<double>(i) / static_cast<double>(errors.size()),
                      errors[i] * 1e-6 / b_n});
  }
  const auto table =
      std::make_shared<const PeriodicTable>("pitch errors", points, Interpolation::cubic);
  target->add_curve("pitch_" + gear, table);
  target->add_curve("pitch_bend_" + gear,
                    std::make_shared<const PeriodicTable>(table->bend().times(-1.0)));
}

// The path of contact, 0 to 1, is half a turn. The other half, which nobody reads, leads back.
std::shared_ptr<const PeriodicTable> over_half_a_turn(std::vector<TablePoint> points) {
  if (points.front().phase > 0.0) points.insert(points.begin(), {0.0, points.front().value});
  if (points.back().phase < 1.0) points.push_back({1.0, points.back().value});
  for (TablePoint& point : points) point.phase *= std::numbers::pi;
  return std::make_shared<const PeriodicTable>("damage", points, Interpolation::linear);
}

// The damage of tooth 0 over the path of contact; whether there is one.
bool add_damage_curve(const GearDrawing& drawing, const GearGeometry& geometry, std::size_t gear,
                      double factor, GearTarget* target) {
  const GearKey& key = gear == 0 ? kPinionDamage : kGearDamage;
  const Measured* measured = drawing.measured(key);
  if (measured == nullptr) return false;
  const std::vector<TablePoint>& points = measured->points;
  if (drawing.varies(kDamage) || factor > 0.0) {
    throw DrawingError(
        key, fmt::format("{} and damage both give the damage of one tooth; keep one", key.name));
  }
  if (geometry.helix > 0.0) throw DrawingError(key, fmt::format("{} is for spur gears", key.name));
  constexpr std::size_t kMost = 100;  // the phase grid has a segment for each
  if (points.size() > kMost) {
    throw DrawingError(key, fmt::format("{} has {} points; at most {} are possible", key.name,
                                        points.size(), kMost));
  }
  for (const TablePoint& point : points) {
    if (point.value >= 0.0 && point.value <= 1.0) continue;
    throw DrawingError(key, fmt::format("{} has {} at {}; a share of the stiffness is from 0 to 1",
                                        key.name, point.value, point.phase));
  }
  target->add_curve(gear == 0 ? "damage_curve_p" : "damage_curve_g", over_half_a_turn(points));
  return true;
}

}  // namespace

bool add_faults(const GearDrawing& drawing, const GearGeometry& geometry, double b_n,
                GearTarget* target) {
  const std::vector<double> runout = drawing.pair_or_zero(kRunout);
  const std::vector<double> phase = drawing.pair_or_zero(kRunoutPhase);
  const std::vector<double> damage = drawing.pair_or_zero(kDamage);
  const std::array<double, 2> teeth = {geometry.pinion_teeth, geometry.gear_teeth};
  std::size_t cycle = 1;
  bool is_faulty = false, has_pitch = false;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string gear = i == 0 ? "p" : "g";
    if (drawing.has(kRunout)) {
      target->add("runout_" + gear, runout[i] * 1e-6 / b_n, kRunout, "{:.6g} m / {:.6g} m",
                  runout[i] * 1e-6, b_n);
    }
    if (drawing.has(kRunoutPhase)) {
      target->add("runout_phase_" + gear, phase[i] * std::numbers::pi / 180.0, kRunoutPhase,
                  "{:.6g} degrees", phase[i]);
    }
    if (drawing.has(kDamage)) target->add("damage_" + gear, damage[i], kDamage, "as given");
    // An axis may begin with 0.
    const std::vector<double>* pitch =
        pitch_errors(drawing, i == 0 ? kPinionPitch : kGearPitch, teeth[i]);
    if (pitch != nullptr) add_pitch_errors(gear, *pitch, b_n, target);
    has_pitch = has_pitch || pitch != nullptr;
    const bool is_damaged =
        add_damage_curve(drawing, geometry, i, damage[i], target) || damage[i] > 0.0;
    const bool has_torque = i == 0 && drawing.has(kTorqueFile);
    const bool turns = has_torque || drawing.varies(kRunout, i) || drawing.varies(kDamage, i) ||
                       runout[i] > 0.0 || is_damaged || pitch != nullptr;
    if (turns) cycle = std::lcm(cycle, static_cast<std::size_t>(teeth[i]));
    is_faulty = is_faulty || turns;
  }
  if (is_faulty) {
    target->add("cycle", static_cast<double>(cycle), kTeeth,
                "mesh periods until all comes back: {:.6g} turns of the "
                "pinion, {:.6g} of the gear",
                static_cast<double>(cycle) / teeth[0], static_cast<double>(cycle) / teeth[1]);
  }
  return has_pitch || drawing.varies(kRunout) || runout[0] > 0.0 || runout[1] > 0.0;
}

}  // namespace gearsweep
