// What equal parts have in common, such as the planets of a planetary set, is shown once.
#pragma once

#include "report/detail/findings.hpp"

namespace gearsweep {

// Takes quantities of parts 2, 3, ... out of the lists of all sides where at each speed they are
// those of part 1, but for what a motion that is not periodic leaves to chance, and notes in
// `alike` of how many parts a quantity is. Names of those that were taken out become that of
// part 1.
void join_equal_parts(Sides* sides);

// What a page says of parts that are shown as one though they are not equal to all digits; empty
// otherwise. HTML.
std::string equal_parts_html(const ReportFindings& findings);

}  // namespace gearsweep
