// The manual page, gearsweep(1). Private to this folder.
#pragma once

#include <string>

#include "cli/option_table.hpp"

namespace gearsweep {

// In roff, for man.
std::string manual_page(const CommandTable& table);

}  // namespace gearsweep
