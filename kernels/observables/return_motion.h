// What kind of motion it is where there is no clock, from the two largest Lyapunov exponents and
// from the returns to a section. One exponent of a motion that does not rest is 0, that of a shift
// along it, so:
//   equilibrium     no state changes in the record; or a perturbation shrinks in it by more than
//                   exp(10), and by more than its error, which a transient onto a cycle that is
//                   over has a large one of: the motion ends at rest, or is there;
//   periodic        the state recurs after some returns (recurrence.h), and nothing grows;
//   quasi_periodic  both exponents are 0 and no return recurs, in three dimensions or more, with
//                   the bounds of observables/motion.h;
//   chaotic         as in observables/motion.h, in three dimensions or more;
//   undecided       all else: a cycle that has not settled, one whose period is too long.
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
  return_motion_accumulators = (int)(return_motion_second) + (int)(lyapunov_max_accumulators)
};

#ifdef __OPENCL_VERSION__
enum { return_motion_outputs = RETURN_MOTION_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void return_motion_init(real* sums, const Instant* start) {
  cycle_init(sums + return_motion_cycle, start);
  motion_init(sums + return_motion_motion, start);
  lyapunov_max_init(sums + return_motion_second, start);
}

SHARED_FN void return_motion_step(real* sums, const SectionCrossing* crossing, const Step* step) {
  cycle_step(sums + return_motion_cycle, crossing, step);
}

SHARED_FN void return_motion_end_period(real* sums, const Section* section) {
  Section second = *section;
  second.log_stretching = section->log_stretching + (TANGENTS > 1);  // a line has one exponent
  cycle_end_period(sums + return_motion_cycle, section);
  motion_end_period(sums + return_motion_motion, section);
  lyapunov_max_end_period(sums + return_motion_second, &second);
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
  const mask is_cycle = (without == torus) & !second.neutral;
  // In the plane there is neither a torus nor chaos (Poincare and Bendixson).
  const mask has_room = MODEL_STATE_COUNT > 2 ? zero == zero : zero != zero;
  const real open = lane_select(is_cycle | !has_room, undecided, without);
  const real moving = lane_select(recurs, lane_select(first.grows, undecided, periodic), open);
  mask rests = zero == zero;  // as a motion that sticks
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real low = sums[return_motion_cycle + cycle_low + i];
    const real high = sums[return_motion_cycle + cycle_high + i];
    rests = rests & (high - low <= ROUNDINGS_TOLD * lane_max(lane_abs(low), lane_abs(high)));
  }
  rests = rests | (first.log_stretching < -lane_max(first.error, much));
  const real since = sums[return_motion_cycle + cycle_since];
  out[0] = lane_select(rests, equilibrium, lane_select(since == since, moving, undecided));
}
#endif
