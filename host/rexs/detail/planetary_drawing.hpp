// A gear unit of one planetary stage.
#pragma once

#include "rexs/detail/arrangement.hpp"
#include "rexs/unit_drawing.hpp"

namespace gearsweep {

// As unit_drawing(). Throws NoArrangement for a unit that is not one such stage.
UnitDrawing planetary_drawing(const GearUnit& unit, const std::string& load_case);

}  // namespace gearsweep
