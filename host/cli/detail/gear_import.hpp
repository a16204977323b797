// gearsweep gear import
#pragma once

#include <CLI/CLI.hpp>

namespace gearsweep {

void add_gear_import_command(CLI::App* gear);

}  // namespace gearsweep
