// What kind of motion it is where there is no clock, from the two largest Lyapunov exponents and
// from the returns to a section. One exponent of a motion that does not rest is 0, that of a shift
// along it, so:
//   equilibrium     nothing grows, and no state changes in the record; or a perturbation shrinks in
//   it by more than
//                   exp(10), and by more than its error, which a transient onto a cycle that is
//                   over has a large one of: the motion ends at rest, or is there;
//   periodic        the state recurs after some returns (recurrence.h), and nothing grows;
//   quasi_periodic  both exponents are 0 and no return recurs, with the bounds of
//                   observables/motion.h; the returns of both halves of the record fill the same
//                   box, and none comes much nearer to another than a torus lets it: a periodic
//                   motion that steps make drift, as one that conserves its energy, has two
//                   exponents that are 0, too;
//   chaotic         as in observables/motion.h;
//                   both in three dimensions or more, or where resets or two angles make room;
//   undecided       all else: a cycle that has not settled, one whose period is too long; and in an
//                   early window (host/engine/window.hpp) what goes on settling: all but rest that
//                   nothing changes, and cycles that recur ten times as well as they must.
#include "observables/cycle.h"
#include "observables/motion.h"

#define RETURN_MOTION_ROLE verdict
#define RETURN_MOTION_PER_SECTION
#define RETURN_MOTION_TANGENTS 2
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define RETURN_MOTION_OUTPUTS(X)                                               \
  X(motion_class, "", "undecided periodic quasi_periodic chaotic equilibrium", \
    "kind of motion, by returns to the section and the two largest Lyapunov exponents")
// X(suffix, role)
#define RETURN_MOTION_OUTPUT_ROLES(X) X(motion_class, motion)

enum {
  return_motion_cycle,  // the accumulators of cycle, motion and, of the second exponent,
                        // lyapunov_max
  return_motion_motion = (int)(return_motion_cycle) + (int)(cycle_accumulators),
  return_motion_second = (int)(return_motion_motion) + (int)(motion_accumulators),
  // The box of the returns in the present half of the record, then that in the first half.
  return_motion_min = (int)(return_motion_second) + (int)(lyapunov_max_accumulators)
};
enum { return_motion_max = return_motion_min + PER_STATE };
enum { return_motion_early_min = return_motion_max + PER_STATE };
enum { return_motion_early_max = return_motion_early_min + PER_STATE };
enum { return_motion_accumulators = return_motion_early_max + PER_STATE };

#ifdef __OPENCL_VERSION__
enum { return_motion_outputs = RETURN_MOTION_OUTPUTS(COUNT_OUTPUT) };
enum { return_motion_enough = 16 };  // returns of a torus
// A share of the box of the returns. The 32 first returns of a circle come as near for one torus in
// 200; what drifts comes back by the error of some steps.
#define RETURN_MOTION_NEAR ((scalar)(3e-4))
#define RETURN_MOTION_SETTLED ((scalar)(0.1) * (scalar)(PERIOD_TOLERANCE))
// Whether there is room for a torus, or for chaos: in the plane there is neither (Poincare and
// Bendixson), unless resets or angles fold it.
#ifdef MODEL_HAS_RESETS
#define RETURN_MOTION_ROOM (MODEL_STATE_COUNT > 1)
#else
#define RETURN_MOTION_ROOM (MODEL_STATE_COUNT > 2 || MODEL_ANGLE_COUNT > 1)
#endif

SHARED_FN void return_motion_begin_half(real* sums) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[return_motion_min + i] = INFINITY;
    sums[return_motion_max + i] = -INFINITY;
  }
}

SHARED_FN void return_motion_init(real* sums, const Instant* start) {
  cycle_init(sums + return_motion_cycle, start);
  motion_init(sums + return_motion_motion, start);
  lyapunov_max_init(sums + return_motion_second, start);
  return_motion_begin_half(sums);
  return_motion_begin_half(sums + (int)(return_motion_early_min) - (int)(return_motion_min));
}

SHARED_FN void return_motion_step(real* sums, const SectionCrossing* crossing, const Step* step) {
  cycle_step(sums + return_motion_cycle, crossing, step);
  if (all_lanes(!crossing->where)) return;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real x = crossing->x[i];
    const real low = sums[return_motion_min + i];
    const real high = sums[return_motion_max + i];
    sums[return_motion_min + i] = lane_select(crossing->where, lane_min(low, x), low);
    sums[return_motion_max + i] = lane_select(crossing->where, lane_max(high, x), high);
  }
}

SHARED_FN void return_motion_end_period(real* sums, const Section* section) {
  Section second = *section;
  second.log_stretching = section->log_stretching + (TANGENTS > 1);  // a line has one exponent
  cycle_end_period(sums + return_motion_cycle, section);
  motion_end_period(sums + return_motion_motion, section);
  lyapunov_max_end_period(sums + return_motion_second, &second);
  if (section->number != section->record / 2) return;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[return_motion_early_min + i] = sums[return_motion_min + i];
    sums[return_motion_early_max + i] = sums[return_motion_max + i];
  }
  return_motion_begin_half(sums);
}

// Whether returns lie as those of a torus do.
SHARED_FN mask return_motion_fills(const real* sums) {
  real ranges[MODEL_STATE_COUNT];
  share_ranges(sums + return_motion_motion + motion_recurrence + period_ranges, ranges);
  const MotionExtents halves = motion_halves(sums + return_motion_min, ranges);
  const real* recurrence = sums + return_motion_cycle + cycle_recurrence;
  return (recurrence[recurrence_number] >= (scalar)(return_motion_enough)) & motion_fills(&halves) &
         (recurrence[recurrence_closest] >= RETURN_MOTION_NEAR * halves.whole);
}

SHARED_FN void return_motion_finish(const real* sums, SweepRound round, real* out) {
  const real zero = 0;
  const real undecided = MOTION_undecided;
  const real periodic = MOTION_periodic;
  const real equilibrium = MOTION_equilibrium;
  const real forcing = sums[return_motion_motion + motion_forcing];
  const MotionGrowth first =
      motion_growth(sums + return_motion_motion + motion_exponent, forcing, round);
  const MotionGrowth second = motion_growth(sums + return_motion_second, forcing, round);
  const mask recurs = zero < recurrence_found(sums + return_motion_cycle + cycle_recurrence);
  const real without = motion_without_period(sums + return_motion_motion, first, round);
  const real torus = MOTION_quasi_periodic;
  const real much = 10;
  // A cycle that has not settled is neutral, too, but not across.
  const mask is_torus = second.neutral & return_motion_fills(sums);
  const mask is_cycle = (without == torus) & !is_torus;
  const mask has_room = RETURN_MOTION_ROOM ? zero == zero : zero != zero;
  const real open = lane_select(is_cycle | !has_room, undecided, without);
  const real moving = lane_select(recurs, lane_select(first.grows, undecided, periodic), open);
  mask rests = zero == zero;  // as a motion that sticks
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real low = sums[return_motion_cycle + cycle_low + i];
    const real high = sums[return_motion_cycle + cycle_high + i];
    rests = rests & (high - low <= ROUNDINGS_TOLD * lane_max(lane_abs(low), lane_abs(high)));
  }
  const mask unstable = rests & first.grows;
  const mask still = rests;
  rests = rests | (first.log_stretching < -lane_max(first.error, much));
  const real worst = sums[return_motion_cycle + cycle_recurrence + recurrence_worst];
  const mask settled = round.is_early ? worst <= RETURN_MOTION_SETTLED : zero == zero;
  const real since = sums[return_motion_cycle + cycle_since];
  out[0] = lane_select(rests, equilibrium, lane_select(since == since, moving, undecided));
  out[0] = lane_select(unstable, undecided, out[0]);
  const mask ends = still | (settled & !rests & (out[0] == periodic));
  out[0] = lane_select(round.is_early ? ends : zero == zero, out[0], undecided);
}
#endif
