// A shell that does what documentation shows, on few points.
#pragma once

#include <string>

#include "support/process.hpp"

namespace gearsweep::testing {

// Runs shell commands in the folder as a reader would give them, but on few points
// (small/gearsweep), and without anything that a shell has set beside HOME and PATH.
Outcome run_small(const Folder& folder, const std::string& commands);

}  // namespace gearsweep::testing
