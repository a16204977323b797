// What a run tells of a load spectrum.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/result.hpp"

namespace gearsweep {

// Some lines; nothing of a study without a spectrum.
std::string describe_spectrum(const SweepResult& result);
// The same as an object; null of a study without.
nlohmann::json spectrum_as_json(const SweepResult& result);

}  // namespace gearsweep
