// The study of a stage of a gear unit that was read from a file.
#pragma once

#include <string>
#include <vector>

#include "rexs/stage_drawing.hpp"

namespace gearsweep {

struct ImportedGear {
  std::string toml;                // as gear_text() writes it
  std::vector<std::string> notes;  // of the drawing, and where the file's numbers and ours disagree
};

// Throws InputError where the stage is no gear pair that there can be. source: the file's name.
ImportedGear imported_gear_study(const StageDrawing& drawing, const std::string& source);

}  // namespace gearsweep
