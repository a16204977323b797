// The gearsweep program, run as a user does.
#pragma once

#include <string>
#include <vector>

namespace gearsweep::bench {

struct Outcome {
  double points = 0.0, steps = 0.0;
  double wall_seconds = 0.0;       // from the start of the process to its end, result file closed
  double computing_seconds = 0.0;  // of these, in tiles: launches, transfers, packing
  double core_seconds = 0.0;       // of all cores
  double peak_bytes = 0.0;         // resident
};

struct Command {
  std::string study;                          // what "gearsweep run" takes
  std::vector<std::string> overrides = {};    // of its keys
  std::vector<std::string> options = {};      // more of the command line
  std::vector<std::string> environment = {};  // "NAME=value", beside this process's own
};

// Into a file that is removed afterwards. Throws RunError when the command fails.
Outcome run(const Command& command);

}  // namespace gearsweep::bench
