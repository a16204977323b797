// The manual page of study files, gearsweep-study(5), from the table of their keys.
#pragma once

#include <string>

namespace gearsweep {

// In roff, for man.
std::string study_manual_page();

}  // namespace gearsweep
