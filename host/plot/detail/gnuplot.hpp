// The child process that plots.
#pragma once

#include <string>

namespace gearsweep {

// Throws RunError when gnuplot is not installed.
void ensure_gnuplot();

// Runs a script with gnuplot's defaults; ARG1 is the path of the picture, if there is one. Whatever
// the names of the two files, they are files. Throws RunError, with what gnuplot said, when it is
// not installed or fails.
void run_gnuplot(const std::string& script, const std::string& picture = "");

}  // namespace gearsweep
