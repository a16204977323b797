#include "gear/detail/engagement.hpp"

#include <fmt/format.h>

#include <cmath>

#include "gear/detail/mesh_stiffness.hpp"
#include "gear/detail/torque.hpp"

namespace gearsweep {
namespace {

constexpr double kLongest = 0.5;  // base pitches

// So far ahead, in base pitches, a pair touches that is `deflection` mm late.
double touches_ahead(double driving_base, double driven_base, const GearGeometry& geometry,
                     double tip, double deflection) {
  double low = 0.0, high = kLongest;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    const double gap =
        corner_gap(driving_base, driven_base, geometry.alpha, tip, middle * geometry.base_pitch);
    (gap < deflection ? low : high) = middle;
  }
  return low;
}

}  // namespace

double corner_gap(double driving_base, double driven_base, double alpha, double tip, double ahead) {
  // Around the driving gear's centre: across the line of action, and along it, the way it drives.
  const double length = (driving_base + driven_base) * std::tan(alpha);
  const double turn = ahead / driven_base;
  const double corner = std::hypot(driven_base, tip), place = std::atan2(tip, driven_base) + turn;
  const double across = driving_base + driven_base - corner * std::cos(place);
  const double along = length - corner * std::sin(place);
  const double string = std::sqrt(across * across + along * along - driving_base * driving_base);
  const double met = driving_base * (std::atan2(along, across) - std::atan(string / driving_base)) +
                     string;  // where the flank through the corner crosses the line of action
  return met - (length - tip - ahead);
}

void add_engagement(const GearDrawing& drawing, const GearGeometry& geometry,
                    const ContactPath& path, const GearBases& bases, GearTarget* target) {
  const bool is_gradual = drawing.choice(kToothEntry) == "gradual";
  if (const std::optional<double> given = drawing.number(kEngagement)) {
    if (is_gradual) {
      throw DrawingError(kEngagement,
                         "engagement and tooth_entry = \"gradual\" both say how a pair takes up "
                         "its load; keep one");
    }
    return target->add("engagement", *given, kEngagement, "as given");
  }
  if (!is_gradual) return;
  if (geometry.helix > 0.0) {
    throw DrawingError(kToothEntry,
                       "tooth_entry = \"gradual\" is for spur gears; a helix makes the entry "
                       "gradual by itself");
  }
  const double force = mean_torque(drawing) / bases.pinion_base;
  const double single = bases.stiffness_factor * bases.k0 / pairs_in_mean(path.contact_ratio());
  const double deflection = force / single * 1e3;
  const auto reach = [&](double share, double base) {
    return base * std::tan(geometry.alpha) + share * geometry.base_pitch;
  };
  const double entry = touches_ahead(geometry.pinion_base, geometry.gear_base, geometry,
                                     reach(path.approach, geometry.gear_base), deflection);
  const double exit = touches_ahead(geometry.gear_base, geometry.pinion_base, geometry,
                                    reach(path.recess, geometry.pinion_base), deflection);
  const double engagement = 0.5 * (entry + exit);
  target->add("engagement", engagement, kToothEntry,
              "estimate: one pair gives way by {:.4g} um, F/c' = {:.6g} N / {:.6g} N/m, so "
              "tips touch {:.4g} base pitches early at the entry and {:.4g} late at the exit; "
              "tip relief is not counted",
              deflection * 1e3, force, single, entry, exit);
}

}  // namespace gearsweep
