// Which stage of a gear unit, and which of its load cases.
#pragma once

#include <string>

#include "rexs/gear_unit.hpp"

namespace gearsweep {

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
