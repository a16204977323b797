// The windows of a trajectory that are recorded: the study's own, and longer ones after it for
// points whose motion could not be told from it.
#pragma once

#include <cstddef>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

// Numbers of periods.
struct Window {
  std::size_t before = 0;  // that the trajectory has behind it when the window begins
  std::size_t settle = 0;  // advanced without recording
  std::size_t record = 1;
  std::size_t samples = 0;  // of the record, the first so many give samples of the section
  bool is_last = true;      // no longer window follows: this one must do for a verdict
  bool is_early = false;    // the study's own follows, unless the motion has settled beyond doubt
};

// Short ones within the study's settling, for motions that settle early on a cycle (of a model that
// nothing drives). Then the study's settle and record. Each next one follows on the end of the one
// before it and is twice as long, up to integrate.extend times the record; these serve only the
// points that are undecided (kernels/observables/motion.h), and are there only when the study looks
// for kinds of motion.
std::vector<Window> windows_of(const Study& study);

// The study's own among its windows.
Window own_window(const Study& study);

}  // namespace gearsweep
