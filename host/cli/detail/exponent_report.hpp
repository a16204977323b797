// What a run says of its Lyapunov spectra (sweep/exponent_checks.hpp).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/result.hpp"

namespace gearsweep {

// A line for each check; empty without spectra.
std::string describe_exponent_checks(const SweepResult& result);
// Null without spectra.
nlohmann::json exponent_checks_as_json(const SweepResult& result);

}  // namespace gearsweep
