// The command line: parses it, runs the command, prints. Nothing else prints.
#pragma once

namespace gearsweep {

// The exit status, one of exit_meanings() (commands.hpp).
int run_cli(int argc, char** argv);

}  // namespace gearsweep
