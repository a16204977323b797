// What the dynamic factor of ISO 6336-1 takes of a drawing.
#pragma once

#include <optional>

#include "gear/detail/bases.hpp"
#include "gear/detail/contact_path.hpp"
#include "gear/dynamic_factor.hpp"

namespace gearsweep {

// Nothing where the drawing has no deviations. Throws DrawingError where it has some of them only.
std::optional<DynamicFactorInput> dynamic_factor_input(const GearDrawing& drawing,
                                                       const GearGeometry& geometry,
                                                       const ContactPath& path,
                                                       const GearBases& bases, GearTarget* target);

}  // namespace gearsweep
