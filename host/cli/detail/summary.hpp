// What a run tells at its end.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/result.hpp"

namespace gearsweep {

// Several lines: points by status and class, time, speed, file.
// A line that names the states which are integrated, where these are fewer than the model has; else
// nothing.
std::string describe_integrated(const std::vector<std::string>& integrated, std::size_t states);

std::string describe_run(const SweepResult& result, const std::string& path);

// The same for scripts, as one JSON object.
std::string run_as_json(const SweepResult& result, const std::string& path);

std::string shard_as_json(const std::string& shard, const std::string& journal, std::size_t points);

// The exit status that a result deserves: kFailed, and a word about it, when every point failed.
int status_of(const SweepResult& result);

}  // namespace gearsweep
