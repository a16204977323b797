// The gearsweep program, run as a user does.
#pragma once

#include <atomic>
#include <string>
#include <vector>

namespace gearsweep {

struct ProgramCall {
  std::string study;                        // what "gearsweep run" takes
  std::vector<std::string> overrides = {};  // of its keys
  std::vector<std::string> options = {};    // more of the command line
  // "NAME=value" beside this process's own or instead of them; "NAME": without that one.
  std::vector<std::string> environment = {};
};

struct ProgramCost {
  double points = 0.0, steps = 0.0;
  double wall_seconds = 0.0;       // from the start of the process to its end, result file closed
  double computing_seconds = 0.0;  // of these, in tiles: launches, transfers, packing
  double core_seconds = 0.0;       // of all cores
  double peak_bytes = 0.0;         // resident
};

// program: the file of gearsweep. Its result goes into a file that is removed afterwards; what it
// says is not shown. Throws RunError when it fails, with its words, and when `stop` was set, which
// kills it.
ProgramCost run_program(const std::string& program, const ProgramCall& call,
                        const std::atomic<bool>* stop = nullptr);

}  // namespace gearsweep
