#include "gear/ring_mesh.hpp"

#include <cmath>
#include <numbers>

namespace gearsweep {

bool RingContact::is_usable() const {
  constexpr double kLeast = 1.001, kMost = 1.999;  // of the model planetary
  return before > 0.0 && after > 0.0 && ratio() >= kLeast && ratio() <= kMost;
}

RingContact ring_contact(const RingPair& pair) {
  const double base = pair.reference * pair.planet_teeth * std::cos(pair.alpha);
  const double ring_base = pair.reference * pair.ring_teeth * std::cos(pair.alpha);
  const double working = std::acos((ring_base - base) / pair.centre);
  const double pitch = 2.0 * std::numbers::pi * pair.reference * std::cos(pair.alpha);
  const double planet = std::sqrt(pair.planet_tip * pair.planet_tip - base * base);
  const double ring = std::sqrt(pair.ring_tip * pair.ring_tip - ring_base * ring_base);
  return {(ring_base * std::tan(working) - ring) / pitch,
          (planet - base * std::tan(working)) / pitch, base * std::tan(working) / pitch};
}

}  // namespace gearsweep
