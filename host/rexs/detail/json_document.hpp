// REXS in JSON.
#pragma once

#include <string>

#include "rexs/document.hpp"

namespace gearsweep {

// As read_rexs() of a text in JSON. Its attributes have no lines.
RexsDocument read_json_document(const std::string& text, const std::string& source);

}  // namespace gearsweep
