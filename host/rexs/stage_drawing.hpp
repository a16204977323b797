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

// A load case, as the drawing's pinion has it: N m, rpm, share of the time.
struct DrawnLoad {
  std::string id;
  std::optional<double> torque, speed, share;
};

struct StageDrawing {
  std::map<std::string_view, DrawnKey> keys;  // by the names of drawing_keys.hpp
  int teeth[2] = {0, 0};
  double module = 0.0;                  // mm
  std::optional<double> face_width;     // mm
  std::optional<double> contact_ratio;  // what the file says
  // Stiffness of the teeth over that of steel, by the moduli of both materials: E/E_steel with
  // E = 2 E1 E2/(E1 + E2), as ISO 6336-1 has it for materials other than steel.
  double stiffness_factor = 1.0;
  double fastest = 0.0;                       // rpm of the pinion in all load cases; 0: not known
  std::map<std::string, std::string> tables;  // the numbers of files that keys name
  std::string about;                          // what was read, lines for a comment
  std::vector<DrawnLoad> cases;
  std::vector<std::string> notes;          // what disagrees, and what is not in the file
  std::vector<std::string> bearing_notes;  // the same of bearings
};

// How a stage is looked at.
struct StageView {
  std::optional<std::size_t> first;  // the gear that stands first; otherwise that of fewer teeth
  int meshes = 1;                    // that share the torque of the first gear
};

// Lines for a comment, one for each.
std::string text_of(const std::vector<DrawnLoad>& cases);

// Numbers of stages count from 0, as those of load cases do. Throws InputError for a stage of which
// no study can be made.
StageDrawing stage_drawing(const GearUnit& unit, std::size_t stage, std::size_t load_case,
                           const StageView& view = {});

}  // namespace gearsweep
