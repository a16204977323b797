// Studies of gear units that were read from a file: of a stage, or of the whole.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rexs/stage_drawing.hpp"
#include "rexs/unit_drawing.hpp"

namespace gearsweep {

struct ImportedGear {
  std::string toml;                // as gear_text() writes it
  std::vector<std::string> notes;  // of the drawing, and where the file's numbers and ours disagree
};

// What a study is of: a range of speeds, or the load cases with their shares of the time.
enum class ImportedPoints : std::uint8_t { speeds, load_spectrum };

// Throws InputError where the stage is no gear pair that there can be, and where a load spectrum
// lacks torques, speeds or shares, with all of them. source: the file's name.
ImportedGear imported_gear_study(const StageDrawing& drawing, const std::string& source,
                                 ImportedPoints points = ImportedPoints::speeds);

// The same of a whole unit.
ImportedGear imported_unit_study(const UnitDrawing& drawing, const std::string& source,
                                 ImportedPoints points = ImportedPoints::speeds);

}  // namespace gearsweep
