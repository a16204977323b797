// The steps of a study's run, also where a pilot run has found them (sweep/pilot.hpp) and the
// study's text does not have them. They go with the study: to other processes, into files, and to
// all that is computed of a map's points later.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

struct FoundStep {
  double max_step = 0.0;        // in the model's time
  std::size_t orbit_steps = 1;  // as of Integrate

  static FoundStep of(const Study& study);
  // ", 1/4 of that on orbits", behind the longest step; empty where those have the same.
  std::string words_of_orbits() const;
  // Where attractors are told apart, by where motions are, all motions have the same steps.
  void give_to(Study* study) const;
  // KEY=VALUE, for a study that is read and shall not search again.
  std::vector<std::string> overrides() const;
};

}  // namespace gearsweep
