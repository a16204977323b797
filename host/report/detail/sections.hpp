// The sections of a report, each put at the end of a page. Of two studies each tells of both.
#pragma once

#include "report/detail/findings.hpp"
#include "report/detail/html.hpp"

namespace gearsweep {

// Adds nothing for one study alone.
void add_differences(const Sides& sides, HtmlPage* page);
void add_worst_speeds(const Sides& sides, HtmlPage* page);
void add_natural_frequencies(const Sides& sides, HtmlPage* page);
// Forces and contact, the order map, run-up and run-down.
void add_pictures(const Sides& sides, HtmlPage* page);
// Adds nothing for a study without tolerances.
void add_tolerances(const Sides& sides, HtmlPage* page);
void add_assumptions(const Sides& sides, HtmlPage* page);

}  // namespace gearsweep
