// The integration step that a pilot run finds for a study (sweep/pilot.hpp). What a map was
// computed with serves all that is computed of its points later: traces, views, a report.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

struct FoundStep {
  double max_step = 0.0;        // in the model's time
  std::size_t orbit_steps = 1;  // as of Integrate

  // Where attractors are told apart, by where motions are, all motions have the same steps.
  void give_to(Study* study) const;
  // KEY=VALUE, for a study that is read and shall not search again.
  std::vector<std::string> overrides() const;
};

}  // namespace gearsweep
