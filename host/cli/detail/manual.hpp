// The manual page, gearsweep(1).
#pragma once

#include <string>

#include "cli/detail/option_table.hpp"

namespace gearsweep {

// In roff, for man.
std::string manual_page(const CommandTable& table);

}  // namespace gearsweep
