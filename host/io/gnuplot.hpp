// The child process that draws.
#pragma once

#include <string>
#include <vector>

namespace gearsweep {

// Runs gnuplot with its defaults and these arguments. Throws RunError, with what it said, when it
// is not installed or fails.
void run_gnuplot(const std::vector<std::string>& arguments);

}  // namespace gearsweep
