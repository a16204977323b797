// Tip relief of the gears of a stage.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "rexs/detail/tooth_play.hpp"

namespace gearsweep {

// What the tip relief of both gears takes away from a pair of flanks, over the path of contact from
// 0, where it begins on the second gear's tip circle, to 1, where it ends on the first one's: lines
// "share, um". Amounts and ways are those of the transverse section, in which profiles are measured
// (ISO 1328-1). A tip without a diameter is a module beyond the reference circle with the shift.
// Nothing where a relief begins beyond the path.
std::optional<std::string> tip_relief_table(const std::array<const UnitGear*, 2>& gears,
                                            const StageGeometry& geometry);

}  // namespace gearsweep
