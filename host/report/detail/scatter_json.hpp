// The numbers of a tolerance report, for programs.
#pragma once

#include <string>

#include "report/detail/scatter.hpp"

namespace gearsweep {

// The text of a JSON object (doc/tolerances.md has its names), in SI units where these are known.
// What is not known is null.
std::string scatter_json(const Scatter& scatter, const ToleranceOptions& options);

}  // namespace gearsweep
