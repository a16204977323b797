// A gear study as gears are built: with tolerances, over a speed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/study.hpp"
#include "study/usual_tolerances.hpp"

namespace gearsweep {

struct AsBuiltOptions {
  std::size_t gears = 2000;  // draws
  int tolerance_class = 7;   // of ISO 1328-1, where the study has no [uncertain] of its own
  double percentile = 99.0;  // that gears are judged by
};

struct AsBuilt {
  Study study;
  std::vector<UsualTolerance> assumed;  // where it had no tolerances of its own
  // The largest force between the teeth, and what gears are judged by: the first load factor, else
  // that force. Of a model without such a force the largest value of its first state.
  std::string force, target;
};

// It looks at force, load factor, transmission error, bearings and contact, in each draw, and draws
// start from the nominal motion. Throws InputError for a study of two axes, and as
// usual_tolerances().
AsBuilt as_built(const Study& study, const AsBuiltOptions& options);

// Whether a quantity is the class of a model's one contact, or of one of several.
bool is_contact_class(const std::string& quantity);

}  // namespace gearsweep
