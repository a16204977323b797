// The command line: parses it, runs the command, prints. Nothing else prints.
#pragma once

#include "cli/run_request.hpp"

namespace gearsweep {

// run: what 'gearsweep run' does once its arguments are read. The exit status, one of
// exit_meanings() (commands.hpp).
int run_cli(int argc, char** argv, const Run& run);

}  // namespace gearsweep
