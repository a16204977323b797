#pragma once

#include <string>

namespace gearsweep {

// Asks the desktop, where there is one, to show the address. False when it cannot be asked.
bool open_browser(const std::string& address);

}  // namespace gearsweep
