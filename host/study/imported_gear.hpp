// Studies of gear units that were read from a file: of a stage, or of the whole.
#pragma once

#include <string>
#include <vector>

#include "rexs/stage_drawing.hpp"
#include "rexs/unit_drawing.hpp"

namespace gearsweep {

struct ImportedGear {
  std::string toml;                // as gear_text() writes it
  std::vector<std::string> notes;  // of the drawing, and where the file's numbers and ours disagree
};

// Throws InputError where the stage is no gear pair that there can be. source: the file's name.
ImportedGear imported_gear_study(const StageDrawing& drawing, const std::string& source);

// The same of a whole unit.
ImportedGear imported_unit_study(const UnitDrawing& drawing, const std::string& source);

}  // namespace gearsweep
