// The report of a study whose points are a load spectrum, or of two: an answer, the loads, what was
// assumed.
#pragma once

#include <string>

#include "report/report.hpp"

namespace gearsweep {

// Runs the studies and writes the page. Throws and returns as write_report().
bool write_spectrum_report(const ReportStudies& studies, const std::string& title,
                           const std::string& path, const ReportOptions& options);

}  // namespace gearsweep
