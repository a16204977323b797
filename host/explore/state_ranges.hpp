// How large the states of a study's motions are, whatever its units.
#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "study/study.hpp"

namespace gearsweep {

struct StateRange {
  double low = 0.0, high = 0.0;
};

// [state] From the start of the study's points in the middle of its axes over all that the motion
// from there goes to, and half as far again to either side. A state that stays where it is has its
// own size about it, or 1 about 0. The motion is followed on the host, for a while; where it
// diverges or cannot be followed, the start is all that is known of it. study: with or without
// axes.
std::vector<StateRange> state_ranges(const Study& study);

// Those of one study, found when they are first asked for: that takes up to seconds. Threads may
// share one.
class LateStateRanges {
 public:
  const std::vector<StateRange>& of(const Study& study);
  // Null where nobody has asked for them yet.
  const std::vector<StateRange>* if_known() const { return is_known_ ? &ranges_ : nullptr; }

 private:
  std::once_flag is_found_;
  std::vector<StateRange> ranges_;
  std::atomic<bool> is_known_ = false;
};

}  // namespace gearsweep
