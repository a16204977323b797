#include "gear/detail/doubts.hpp"

#include <fmt/format.h>

#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "gear/detail/bodies.hpp"
#include "gear/steel.hpp"

namespace gearsweep {
namespace {

// A wider gear does not carry over its width: textbooks end at 1.2 to 2 pinion diameters.
constexpr double kWidest = 2.0;
// Between gears with webs and holes, and gears with shafts and flanges, there is less than this.
constexpr double kFactor = 10.0;

class Doubts {
 public:
  Doubts(const GearDrawing& drawing, const GearGeometry& geometry)
      : drawing_(drawing), geometry_(geometry) {}

  std::vector<GearDoubt> run() {
    const double widest = kWidest * 2.0 * reference(0);
    const std::optional<double> width = drawing_.number(kFaceWidth);
    if (width && *width > widest) {
      add(kFaceWidth, fmt::format("face_width_mm = {:.4g} is {:.3g} times the pinion's reference "
                                  "diameter; gears have at most {:g}",
                                  *width, *width / (2.0 * reference(0)), kWidest));
    }
    for (std::size_t gear = 0; drawing_.has(kMass) && gear < kMass.count(); ++gear) {
      const double mass = drawing_.list(kMass)[gear];
      compare_mass(gear, mass, width, width.value_or(widest));
      if (drawing_.has(kInertia)) compare_inertia(gear, drawing_.list(kInertia)[gear], mass);
    }
    const double backlash = 2.0 * drawing_.required(kHalfBacklash);
    if (backlash > 0.5 * geometry_.module) {
      add(kHalfBacklash, fmt::format("half_backlash_mm = {:.4g} is {:.3g} modules; gears have at "
                                     "most 0.25",
                                     0.5 * backlash, 0.5 * backlash / geometry_.module));
    }
    return std::move(doubts_);
  }

 private:
  double reference(std::size_t gear) const {
    return geometry_.reference(gear == 0 ? geometry_.pinion_teeth : geometry_.gear_teeth);
  }

  void add(const GearKey& key, std::string text) { doubts_.push_back({key.name, std::move(text)}); }

  // Without a face width only what no width explains is told.
  void compare_mass(std::size_t gear, double mass, const std::optional<double>& width,
                    double widest) {
    const double radius = reference(gear);
    const double disc = kSteel * std::numbers::pi * radius * radius * widest;
    if (mass <= kFactor * disc && (!width || mass >= disc / kFactor)) return;
    add(kMass, fmt::format("mass_kg = {:.4g} of the {}: a steel disc of its reference diameter and "
                           "{:.4g} mm {}has {:.3g} kg",
                           mass, kWhose[gear], widest, width ? "" : "(twice the pinion's) ", disc));
  }

  void compare_inertia(std::size_t gear, double inertia, double mass) {
    const double radius = reference(gear);
    const double disc = 0.5 * mass * radius * radius;
    if (inertia <= kFactor * disc && inertia >= disc / kFactor) return;
    add(kInertia, fmt::format("inertia_kg_mm2 = {:.4g} of the {}: a disc of its mass and reference "
                              "diameter has {:.3g} kg mm^2",
                              inertia, kWhose[gear], disc));
  }

  const GearDrawing& drawing_;
  const GearGeometry& geometry_;
  std::vector<GearDoubt> doubts_;
};

}  // namespace

std::vector<GearDoubt> doubts_about(const GearDrawing& drawing, const GearGeometry& geometry) {
  return Doubts(drawing, geometry).run();
}

}  // namespace gearsweep
