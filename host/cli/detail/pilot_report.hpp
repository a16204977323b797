// What a pilot run has found (sweep/pilot.hpp), told to people and to scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/result.hpp"

namespace gearsweep {

// One line, that goes on from "steps".
std::string describe_pilot(const PilotFindings& pilot);

nlohmann::json pilot_as_json(const PilotFindings& pilot);

}  // namespace gearsweep
