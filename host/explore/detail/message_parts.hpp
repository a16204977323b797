// What several messages have.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "explore/explorer.hpp"

namespace gearsweep {

// No number in JSON is null.
nlohmann::json number_or_null(double value);

// Bytes that are no UTF-8 are replaced.
std::string dumped(const nlohmann::json& message);

// " --set 'parameters.mu=0.1'", for what is changed of the study that explore was started with.
std::string sets_text(const Explorer& explorer, const std::vector<NamedValue>& sets);

// "omega=0.7,b=1", with all digits: where a point of the scene is, also on axes that the study has
// and the scene does not.
std::string at_text(const Explorer& explorer, const Scene& scene,
                    const std::vector<NamedValue>& at);

// The axes' values, the trace and its spectrum, and what could not be told.
void add_motion(const Motion& motion, nlohmann::json* message);

}  // namespace gearsweep
