// A manual page as a terminal shows it that has no man.
#pragma once

#include <string>

namespace gearsweep {

// The page in plain text, at most so many columns wide where words allow it. roff: what the
// functions of roff.hpp make; no other requests are known.
std::string plain_page(const std::string& roff, int columns);

}  // namespace gearsweep
