// What a run tells at its end. Private to this folder.
#pragma once

#include <string>

#include "engine/result.hpp"

namespace gearsweep {

// Several lines: points by status and class, time, speed, file.
std::string describe_run(const SweepResult& result, const std::string& path);

// The same for scripts, as one JSON object.
std::string run_as_json(const SweepResult& result, const std::string& path);

}  // namespace gearsweep
