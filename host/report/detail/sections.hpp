// The sections of a report, each put at the end of a page.
#pragma once

#include "report/detail/findings.hpp"
#include "report/detail/html.hpp"

namespace gearsweep {

// Words under a picture, with where the other axis of the study is.
std::string caption_of(const std::string& what, const ReportFindings& findings);

void add_data(const ReportFindings& findings, HtmlPage* page);
void add_natural_frequencies(const ReportFindings& findings, HtmlPage* page);
void add_forces(const ReportFindings& findings, HtmlPage* page);
void add_worst_speeds(const ReportFindings& findings, HtmlPage* page);
// Adds nothing for a study without tolerances.
void add_tolerances(const ReportFindings& findings, HtmlPage* page);
void add_order_map(const ReportFindings& findings, HtmlPage* page);
void add_directions(const ReportFindings& findings, HtmlPage* page);
void add_assumptions(const ReportFindings& findings, HtmlPage* page);

}  // namespace gearsweep
