// The drawing of one stage of a gear unit, as keys of [gear].
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rexs/gear_unit.hpp"

namespace gearsweep {

struct DrawnKey {
  std::string value;   // as TOML has it
  std::string origin;  // "from the file", "computed: ...", "ESTIMATE: ..."
};

struct StageDrawing {
  std::map<std::string_view, DrawnKey> keys;  // by the names of drawing_keys.hpp
  int teeth[2] = {0, 0};                      // the pinion, which has fewer teeth, first
  double module = 0.0;                        // mm
  std::optional<double> face_width;           // mm
  std::optional<double> contact_ratio;        // what the file says
  double fastest = 0.0;                       // rpm of the pinion in all load cases; 0: not known
  std::string about;                          // what was read, lines for a comment
  std::vector<std::string> notes;             // what disagrees, and what is not in the file
};

// Numbers of stages count from 0, as those of load cases do. Throws InputError for a stage of which
// no study can be made.
StageDrawing stage_drawing(const GearUnit& unit, std::size_t stage, std::size_t load_case);

// The stage of a number that counts from 1, a name or an id. Without a text, the only one of which
// a study can be made, or the first of planets that are alike. Throws InputError, which lists the
// stages, for any other.
std::size_t chosen_stage(const GearUnit& unit, const std::string& text);

// The load case of an id; without one, the one of the highest torque on the stage. Throws
// InputError.
std::size_t chosen_case(const GearUnit& unit, std::size_t stage, const std::string& id);

// A line for each stage: number, name, teeth, what can be made of it.
std::string list_of_stages(const GearUnit& unit);

}  // namespace gearsweep
