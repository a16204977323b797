// What the numbers of a report rest on.
#pragma once

#include <string>
#include <vector>

#include "report/detail/html.hpp"
#include "study/study.hpp"

namespace gearsweep {

// A number or a choice of the study, and whose it is: "yours", "estimated" or "default", with how
// it came about. HTML.
struct AssumedValue {
  std::string what, value, origin;
  bool is_nothing = false;  // a default of 0, as of a fault that the gears do not have
};

// First those of the drawings, then the other parameters and the options that the equations use.
std::vector<AssumedValue> assumed_values(const Study& study);

// The same as a table at the end of a page.
void add_assumed_values(const Study& study, HtmlPage* page);

}  // namespace gearsweep
