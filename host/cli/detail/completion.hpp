// Completion for shells.
#pragma once

#include <string>

#include "cli/detail/option_table.hpp"

namespace gearsweep {

// A script for bash, which zsh reads, too, through its bashcompinit.
std::string bash_completion(const CommandTable& table);

std::string fish_completion(const CommandTable& table);

}  // namespace gearsweep
