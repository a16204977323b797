// What a report calls things: in the trade's words, with the program's own names small beside them.
#pragma once

#include <string>
#include <utility>

#include "report/detail/findings.hpp"

namespace gearsweep {

// A key of a drawing as words and a unit: {"mesh stiffness", "N/m"} of "mesh_stiffness_N_per_m".
// Text.
std::pair<std::string, std::string> words_and_unit(const std::string& key);

// "largest meshing force (N) dmf_max". HTML.
std::string quantity_cell(const ResultMap& map);

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
