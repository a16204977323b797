// The bodies of a gear pair.
#pragma once

#include <array>
#include <vector>

#include "gear/detail/geometry.hpp"
#include "gear/detail/target.hpp"

namespace gearsweep {

inline constexpr std::array kWhose = {"pinion", "gear"};

// [pinion, gear]
struct GearBodies {
  std::vector<double> mass;     // kg; empty where the drawing has none, and none is needed
  std::vector<double> inertia;  // kg mm^2
};

// As given, or where the drawing says so those of steel discs, of which a note tells. Throws
// DrawingError for what it lacks, and for a bore that leaves nothing.
GearBodies bodies_of(const GearDrawing& drawing, const GearGeometry& geometry, GearTarget* target);

}  // namespace gearsweep
