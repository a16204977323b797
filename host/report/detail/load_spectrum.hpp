// The report of a study whose points are a load spectrum: an answer, the loads, what was assumed.
#pragma once

#include <string>

#include "report/report.hpp"

namespace gearsweep {

// Runs the study and writes the page. Throws and returns as write_report().
bool write_spectrum_report(const Study& study, const std::string& title, const std::string& path,
                           const ReportOptions& options);

}  // namespace gearsweep
