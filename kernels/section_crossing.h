// Sections: places of a model that a motion is looked at where it comes up through them. Each has
// three signals: its level, which is 0 there, the rate of that, and the size of its terms, whose
// rounding counts as 0: a motion that stays at a section, or at rest, does not come through it. The
// host writes WATCHED_SECTIONS(X), X(number, level, rate, size, whether the level jumps with a
// state), of those that the study looks at, and WATCHED_SECTION_COUNT.
//
// The place in the step is that where the cubic of the level is 0; the state there is on the cubic
// of each state, by the field at both ends: an error of fourth order. A contact that begins in the
// same step bends these cubics; then the error is of second order in the velocities.

#include "rk4/level_cross.h"

#ifdef WATCHED_SECTIONS

SHARED_FN real section_level(real level, real size) {
  const real zero = 0;
  return lane_select(lane_abs(level) <= ROUNDINGS_TOLD * size, zero, level);
}

// From the level and the change that its rate would make in the step, at the step's ends. A level
// that jumps up through 0 between two steps has been there, too.
SHARED_FN void section_find(real level, real change, real end_level, real end_change, real rounding,
                            SectionCrossing* crossing) {
  const real zero = 0;
  const real one = 1;
  const real unbounded = INFINITY;
  const real third = (scalar)(1.0 / 3.0);
  // The cubic lies between these.
  const real inner = level + third * change;
  const real outer = end_level - third * end_change;
  const real low = lane_min(lane_min(level, inner), lane_min(outer, end_level));
  const real high = lane_max(lane_max(level, inner), lane_max(outer, end_level));
  const mask jumps = (crossing->last <= zero) & (zero < level);
  const mask may_cross = (low <= zero) & (rounding < high);
  crossing->last = end_level;
  crossing->where = jumps;
  crossing->share = zero;
  if (all_lanes(!may_cross)) return;
  real after;
  mask is_up;
  mask hits = level_cross(level, end_level, change, end_change, zero, -unbounded, &after, &is_up);
  hits = hits & may_cross & (level <= zero);
  crossing->where = jumps | hits;
  crossing->share = lane_select(hits, after, zero);
  // What dips below it within the step is found on the way back from the end.
  const mask may_dip = may_cross & (zero < level) & (zero < end_level) & !jumps;
  if (all_lanes(!may_dip)) return;
  hits = level_cross(end_level, level, -end_change, -change, unbounded, zero, &after, &is_up);
  hits = hits & may_dip;
  crossing->where = crossing->where | hits;
  crossing->share = lane_select(hits, one - after, crossing->share);
}

// The states there. first, last: the field at the step's ends; length: of the step, in
// dimensionless time.
SHARED_FN void sections_take(real length, const real* before, const real* after, const real* first,
                             const real* last, SectionCrossing* crossings) {
  const real two = 2;
  const real three = 3;
  for (int k = 0; k < WATCHED_SECTION_COUNT; ++k) {
    const real t = crossings[k].share;
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      const real change = after[i] - before[i];
      const real a = length * first[i];
      const real b = length * last[i];
      const real square = three * change - two * a - b;
      const real cube = a + b - two * change;
      crossings[k].x[i] = before[i] + t * (a + t * (square + t * cube));
    }
  }
}

// The change that the level's rate would make in the step is that of a parabola where the motion
// slides along a jump that the level has, too: the rate knows nothing of how the mixture of both
// sides changes, nor of what a motion rests against: where the level stays 0 it is 0.
#define SECTION_FIND(number, level, rate, size, jumps)                                         \
  {                                                                                            \
    const real a = section_level(before->signals.level, before->signals.size);                 \
    const real m = section_level(middle->signals.level, middle->signals.size);                 \
    const real b = section_level(after->signals.level, after->signals.size);                   \
    real first = length * before->signals.rate;                                                \
    real last = length * after->signals.rate;                                                  \
    if (jumps) {                                                                               \
      first = lane_select(slides, four * m - three * a - b, first);                            \
      last = lane_select(slides, a + three * b - four * m, last);                              \
    }                                                                                          \
    const mask stays = (a == zero) & (m == zero) & (b == zero);                                \
    first = lane_select(stays, zero, first);                                                   \
    last = lane_select(stays, zero, last);                                                     \
    section_find(a, first, b, last, ROUNDINGS_TOLD * after->signals.size, &crossings[number]); \
  }

// Whether any lane comes through a section in a step of a length, of dimensionless time. slides:
// where the motion slides along a jump.
SHARED_FN bool sections_find(const Instant* before, const Instant* middle, const Instant* after,
                             real length, mask slides, SectionCrossing* crossings) {
  const real three = 3;
  const real four = 4;
  const real zero = 0;
  mask any = zero != zero;
  WATCHED_SECTIONS(SECTION_FIND)
  for (int k = 0; k < WATCHED_SECTION_COUNT; ++k) any = any | crossings[k].where;
  return !all_lanes(!any);
}

#endif
