// Numbers that a gear pair may have and none has: most often they are in another unit.
#pragma once

#include <vector>

#include "gear/conversion.hpp"
#include "gear/detail/geometry.hpp"

namespace gearsweep {

std::vector<GearDoubt> doubts_about(const GearDrawing& drawing, const GearGeometry& geometry);

}  // namespace gearsweep
