// The drawings of a whole gear unit, for a model of the zoo with a mesh for each.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "rexs/gear_unit.hpp"
#include "rexs/stage_drawing.hpp"

namespace gearsweep {

struct DrawnParameter {
  std::string name, value, origin;
  bool is_default = false;  // of the model: told, and not set
};

struct UnitDrawing {
  std::string model;                                           // "two_stages" or "planetary"
  std::string summary;                                         // "20/40 and 25/50 teeth"
  std::vector<std::pair<std::string, std::string>> options;    // of the model
  std::vector<std::pair<std::string, StageDrawing>> drawings;  // by the model's names of them
  std::vector<DrawnParameter> parameters;                      // of the model, not of a drawing
  std::string about;                                           // lines for a comment
  std::vector<std::string> notes;
};

// For two stages, each external, that share a shaft and no gear; or for a planetary stage with
// three planets that are alike, a sun that drives and a ring that is held. load_case: its id;
// empty: that of the highest torque on the first of the meshes. Throws InputError, with a list of
// the stages and what can be done instead, for any other unit.
UnitDrawing unit_drawing(const GearUnit& unit, const std::string& load_case);

}  // namespace gearsweep
