// The attractors that a sweep found, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/result.hpp"

namespace gearsweep {

// A table, the most visited first, of at most ten; empty when the study has no census.
std::string describe_attractors(const SweepResult& result);

// All of them, in the order of their numbers.
nlohmann::json attractors_as_json(const SweepResult& result);

}  // namespace gearsweep
