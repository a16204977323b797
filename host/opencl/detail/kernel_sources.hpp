// The text of kernels/, embedded in the binary.
#pragma once

#include <map>
#include <string>

namespace gearsweep {

// By path relative to kernels/, as in "rk4/rk4.h".
const std::map<std::string, std::string>& kernel_sources();

}  // namespace gearsweep
