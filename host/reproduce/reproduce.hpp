// The paper's figures, computed, drawn, and held against what it says of them.
#pragma once

#include <string>
#include <vector>

#include "sweep/several_runs.hpp"

namespace gearsweep {

struct ReproduceOptions : SeveralRuns {
  std::string preset;                  // "paper" or "consistent"
  std::string folder;                  // made when it is not there
  std::vector<std::string> overrides;  // of each study: "parameters.F1=0.1"
};

// Runs the built-in studies PRESET/fig4 .. PRESET/fig11 and what the report adds to them, and
// writes into the folder each result, each picture, and report.md. False when `stop` was set.
// Throws InputError for a folder that will not do, RunError.
bool reproduce(const ReproduceOptions& options);

}  // namespace gearsweep
