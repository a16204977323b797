// Which gearsweep this is.
#pragma once

#include <string>

namespace gearsweep {

// "0.2.0".
std::string version();

// SHA-256 over the sources that decide numbers (host/hash.cmake), so that a result tells what
// computed it, and a journal what may continue it.
std::string source_hash();

}  // namespace gearsweep
