// Which gearsweep this is.
#pragma once

#include <string>

namespace gearsweep {

// "0.1.0".
std::string version();

// SHA-256 over the sources in kernels/ and host/, so that a result tells what computed it.
std::string source_hash();

}  // namespace gearsweep
