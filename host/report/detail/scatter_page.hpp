// The page of a tolerance report.
#pragma once

#include "report/detail/html.hpp"
#include "report/detail/scatter.hpp"

namespace gearsweep {

// Pictures are drawn into the folder of the scatter.
HtmlPage scatter_page(const Scatter& scatter, const ToleranceOptions& options);

}  // namespace gearsweep
