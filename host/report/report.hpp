// A report on a study over speed, as one page for the screen or for A4: a sentence that answers,
// worst speeds, natural frequencies and critical speeds, forces and contact, the order map, run-up
// and run-down, what was given and what was assumed. Of two studies, side by side, also what
// differs. Of a load spectrum the answer over all loads.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"
#include "sweep/several_runs.hpp"

namespace gearsweep {

// The order map uses the first of the devices.
struct ReportOptions : SeveralRuns {
  std::string command_line;
};

struct ReportStudy {
  Study study;
  std::string name;  // what it is called beside another one, as "cracked"
};

// The study of the report, or two of which the second is compared with the first.
using ReportStudies = std::vector<ReportStudy>;

// Throws InputError unless each study has an axis that is a speed, that is, changes the period of
// the forcing, or the only one is a load spectrum, both are in the same units, and the report can
// be put there (.html, or .pdf where there is a Chromium that prints it); RunError when gnuplot is
// not installed.
void ensure_report(const ReportStudies& studies, const std::string& path);

// Runs what the report takes, and writes it, whole or not at all. Its pictures are in the page
// itself. False when stopped. Throws as ensure_report(), and RunError.
bool write_report(const ReportStudies& studies, const std::string& path,
                  const ReportOptions& options);

}  // namespace gearsweep
