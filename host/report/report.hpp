// A report on a study over speed, as one page of HTML: the data, natural frequencies and critical
// speeds, forces and contact, worst speeds, the order map, run-up and run-down, what was assumed.
#pragma once

#include <string>

#include "study/study.hpp"
#include "sweep/several_runs.hpp"

namespace gearsweep {

// The order map uses the first of the devices.
struct ReportOptions : SeveralRuns {
  std::string command_line;
};

// Throws InputError unless the study has an axis that is a speed, that is, changes the period of
// the forcing, and the report can be put there; RunError when gnuplot is not installed.
void ensure_report(const Study& study, const std::string& path);

// Runs what the report takes, and writes it, whole or not at all. Its pictures are in the page
// itself. False when stopped. Throws as ensure_report(), and RunError.
bool write_report(const Study& study, const std::string& path, const ReportOptions& options);

}  // namespace gearsweep
