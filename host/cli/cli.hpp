// The command line: parses it, runs the command, prints. Nothing else prints.
#pragma once

namespace gearsweep {

// Exit status: 0 done, 1 failed while running, 2 the input was wrong, 130 interrupted.
int run_cli(int argc, char** argv);

}  // namespace gearsweep
