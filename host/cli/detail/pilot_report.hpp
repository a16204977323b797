// The step of a run, and who found it, told to people and to scripts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/result.hpp"

namespace gearsweep {

// One line, that goes on from "steps": what a pilot run has found (sweep/pilot.hpp), or else the
// study of a model without max_step (study/own_step.hpp). Empty where the step was given.
std::string describe_steps(const Study& study, const std::optional<PilotFindings>& pilot);

// What a period is, of a model without forcing; empty of others.
std::string describe_clock(const Study& study);

nlohmann::json pilot_as_json(const PilotFindings& pilot);

}  // namespace gearsweep
