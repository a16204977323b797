// What a report calls things: in the trade's words, with the program's own names small beside them.
#pragma once

#include <string>

#include "report/detail/findings.hpp"

namespace gearsweep {

// "largest meshing force (N) dmf_max". Of equal parts "dmf_s1_max to dmf_s3_max" is the name. HTML.
std::string quantity_cell(const Model& model, const ResultMap& map);
std::string quantity_cell(const ReportFindings& findings, const ResultMap& map);

// The same without the unit. HTML.
std::string named_html(const ReportFindings& findings, const std::string& quantity);

// The value of a map as a table has it: classes by their names, shares as per cent, "–" for none.
// HTML.
std::string value_cell(const ResultMap& map, std::size_t point);

// Whether it is a share of the time.
bool is_share(const ResultMap& map);

// Where the report's curves are: " (mu = 0.05)"; empty without another axis. HTML.
std::string place_html(const ReportFindings& findings);

// Words under a picture, with where the other axis of the study is. HTML.
std::string caption_of(const std::string& what, const ReportFindings& findings);

}  // namespace gearsweep
