// Answers for scripts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace gearsweep {

// Several lines, the last one ended. Names of files and texts of other programs need not be UTF-8,
// as JSON must be: other bytes become U+FFFD.
inline std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace gearsweep
