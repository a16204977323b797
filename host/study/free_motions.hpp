// What the motions of a model without forcing look like, which the host follows from a few of a
// study's points: how long they take to come back, and which state tells them best.
#pragma once

#include <cstddef>
#include <optional>

#include "study/study.hpp"

namespace gearsweep {

struct FreeMotions {
  // After which they come back to the model's first section, on average; the median of the points.
  // 0 where none does.
  double return_time = 0.0;
  // The state by whose maxima motions are judged, where those of the state that the model's own
  // section looks at tell nothing: it decays, it is conserved, or it stays at its largest value, so
  // that rounding says when that is. It has peaks, and goes on moving, in most of the motions
  // looked at, the first of several such states; nothing where none is better.
  std::optional<std::size_t> better_state;
};

// What nobody asks for is not looked at.
FreeMotions look_at_free_motions(const Study& study, bool for_peaks, bool for_returns);

}  // namespace gearsweep
