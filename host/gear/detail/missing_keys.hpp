// What a drawing does not have and its model needs.
#pragma once

#include "gear/detail/target.hpp"

namespace gearsweep {

// Throws DrawingError that lists all of it, each with the advice of its key.
void require_keys(const GearDrawing& drawing, const GearTarget& target);

}  // namespace gearsweep
