// Where the motions start that a study is probed by.
#pragma once

#include <vector>

#include "study/study.hpp"

namespace gearsweep {

struct ProbeStart {
  ModelSetting setting;
  std::vector<double> state;
};

// At the corners and the middles of two axes, or at five places of one; without those that the plan
// will refuse.
std::vector<ProbeStart> probe_starts(const Study& study);

}  // namespace gearsweep
