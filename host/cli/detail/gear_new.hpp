// gearsweep gear new
#pragma once

#include <CLI/CLI.hpp>

namespace gearsweep {

void add_gear_new_command(CLI::App* gear);

}  // namespace gearsweep
