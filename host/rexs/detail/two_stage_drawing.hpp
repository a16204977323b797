// A gear unit of two stages.
#pragma once

#include "rexs/detail/arrangement.hpp"
#include "rexs/unit_drawing.hpp"

namespace gearsweep {

// As unit_drawing(). Throws NoArrangement for a unit that is not of two such stages.
UnitDrawing two_stage_drawing(const GearUnit& unit, const std::string& load_case);

}  // namespace gearsweep
