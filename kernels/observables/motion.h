// What kind of motion it is, from two witnesses: whether the full state at phase 0 recurs
// (observables/period.h), and what a small perturbation grew by over the record, with the error of
// that (observables/lyapunov_max.h). Growth counts as positive or negative when it is so by more
// than three standard errors.
//   periodic        a period, and no positive growth;
//   chaotic         no period, and positive growth by more than a factor exp(2), since even what
//                   neither grows nor decays in the long run varies while it is carried round; and
//                   a section that does not grow a hundredfold from the record's first half to its
//                   second, nor by as much as the perturbation in half the record, both of which a
//                   motion without bounds does;
//   quasi_periodic  no period, and for 1000 periods or more neither growth nor decay: by no more
//                   than the errors allow, nor than exp(10); a hundredth is nothing; and a section
//                   whose extent, relative to the ranges of the motion, is no more than a quarter
//                   above those of the record's halves, so that it neither grows nor drifts, or is
//                   a tenth of the ranges: a cycle seen by a clock that nearly agrees with it.
//                   With a second frequency what decays counts, too: the second phase goes on;
//   undecided       all else: witnesses that contradict each other, a slow transient, a period
//                   beyond the longest, chaos too weak for the record.
// In the last window (host/engine/window.hpp) fewer periods do for quasi_periodic. What decays goes
// to a periodic orbit, but as long as its period does not show, it stays undecided: a class that is
// periodic has a period.
#include "observables/lyapunov_max.h"
#include "observables/period.h"

#define MOTION_ROLE verdict
#define MOTION_TANGENTS 1
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define MOTION_OUTPUTS(X)                                                                         \
  X(class, "", "undecided periodic quasi_periodic chaotic",                                       \
    "kind of motion, by recurrence after forcing periods and largest Lyapunov exponent; a limit " \
    "cycle without forcing is quasi_periodic")
// X(suffix, role)
#define MOTION_OUTPUT_ROLES(X) X(class, motion)

enum {
  motion_forcing,    // the forcing period
  motion_recurrence  // then: the accumulators of period and lyapunov_max, the section's box
};
enum { motion_exponent = (int)(motion_recurrence) + (int)(period_accumulators) };
enum { motion_min = (int)(motion_exponent) + (int)(lyapunov_max_accumulators) };
enum { motion_max = motion_min + PER_STATE };  // both: in the present half of the record
// Both: in the first half, once it is over.
enum { motion_early_min = motion_max + PER_STATE };
enum { motion_early_max = motion_early_min + PER_STATE };
enum { motion_accumulators = motion_early_max + PER_STATE };

#ifdef __OPENCL_VERSION__
enum { motion_outputs = MOTION_OUTPUTS(COUNT_OUTPUT) };
enum { motion_min_neutral = 1000 };  // periods
enum { motion_runaway = 100 };       // times the extent of the section

SHARED_FN void motion_begin_half(real* sums, const real* x) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[motion_min + i] = x[i];
    sums[motion_max + i] = x[i];
  }
}

SHARED_FN void motion_extents(const real* min, const real* max, real* extents) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) extents[i] = max[i] - min[i];
}

// The largest component, relative to what each is measured by; one that has no range is at rest.
SHARED_FN real motion_size(const real* extents, const real* ranges) {
  const real zero = 0;
  real size = 0;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    size = lane_max(size, lane_select(zero < ranges[i], extents[i] / ranges[i], zero));
  }
  return size;
}

// How far sections extend, relative to the ranges: in the first half of the record, in the second,
// and in both. box: motion_min, and the three behind it.
typedef struct {
  real early, late, whole;
} MotionExtents;

SHARED_FN MotionExtents motion_halves(const real* box, const real* ranges) {
  const real* min = box;
  const real* max = box + MODEL_STATE_COUNT;
  const real* early_min = box + 2 * MODEL_STATE_COUNT;
  const real* early_max = box + 3 * MODEL_STATE_COUNT;
  real extents[MODEL_STATE_COUNT];
  MotionExtents halves;
  motion_extents(early_min, early_max, extents);
  halves.early = motion_size(extents, ranges);
  motion_extents(min, max, extents);
  halves.late = motion_size(extents, ranges);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    extents[i] = lane_max(early_max[i], max[i]) - lane_min(early_min[i], min[i]);
  }
  halves.whole = motion_size(extents, ranges);
  return halves;
}

// Whether both halves fill the same box, which neither grows nor drifts then.
SHARED_FN mask motion_fills(const MotionExtents* halves) {
  const scalar more = 1.25;
  return (halves->whole <= more * halves->early) & (halves->whole <= more * halves->late);
}

SHARED_FN void motion_init(real* sums, const Instant* start) {
  sums[motion_forcing] = 0;
  period_init(sums + motion_recurrence, start);
  lyapunov_max_init(sums + motion_exponent, start);
  motion_begin_half(sums, start->x);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[motion_early_min + i] = start->x[i];
    sums[motion_early_max + i] = start->x[i];
  }
}

SHARED_FN void motion_step(real* sums, const Step* step) {}

SHARED_FN void motion_end_period(real* sums, const Section* section) {
  const real* x = section->x;
  sums[motion_forcing] = section->period;
  period_end_period(sums + motion_recurrence, section);
  lyapunov_max_end_period(sums + motion_exponent, section);
  if (section->number == section->record / 2) {
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      sums[motion_early_min + i] = sums[motion_min + i];
      sums[motion_early_max + i] = sums[motion_max + i];
    }
    motion_begin_half(sums, x);
  }
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[motion_min + i] = lane_min(sums[motion_min + i], x[i]);
    sums[motion_max + i] = lane_max(sums[motion_max + i], x[i]);
  }
}

// What a perturbation grew by in the record.
typedef struct {
  real log_stretching, error;  // three standard errors
  mask grows;                  // by more than that
  mask neutral;                // by no more than that, nor than exp(10); a hundredth is nothing
} MotionGrowth;

// sums: of lyapunov_max.
SHARED_FN MotionGrowth motion_growth(const real* sums, real forcing, SweepRound round) {
  real exponent[lyapunov_max_outputs];
  lyapunov_max_finish(sums, round, exponent);
  const real time = (scalar)(round.record) * forcing;
  const real much = 10;
  const real nothing = (scalar)(0.01);
  MotionGrowth growth;
  growth.log_stretching = exponent[0] * time;
  growth.error = (scalar)(3) * exponent[1] * time;
  // A direction that is neither stretched nor shrunk, as along a clock, has rounding.
  const real rounding = (scalar)(REAL_BITS == 64 ? 1e-9 : 1e-4);
  growth.grows = growth.log_stretching > lane_max(growth.error, rounding);
  const real size = lane_abs(growth.log_stretching);
  growth.neutral = (size <= nothing) | ((size <= growth.error) & (size <= much));
#if MODEL_CLOCKS > 0
  // The second phase never returns, whatever decays beside it.
  growth.neutral = growth.neutral | !growth.grows;
#endif
  return growth;
}

// The kind of a motion without a period.
SHARED_FN real motion_without_period(const real* sums, MotionGrowth growth, SweepRound round) {
  const real turn = 2;
  const real log_stretching = growth.log_stretching;
  const mask positive = growth.grows & (log_stretching > turn);
  real ranges[MODEL_STATE_COUNT];
  share_ranges(sums + motion_recurrence + period_ranges, ranges);
  const MotionExtents halves = motion_halves(sums + motion_min, ranges);
  // A linear growth has exp(log_stretching / 2).
  const real grown = lane_min(exp((scalar)(0.4) * log_stretching), (real)(motion_runaway));
  const mask stays = halves.late <= grown * halves.early;
  const mask steady = (halves.whole <= (scalar)(0.1)) | motion_fills(&halves);

  real bounded = MOTION_undecided;
  if (round.is_last || round.record >= motion_min_neutral) {
    bounded = lane_select(growth.neutral & steady, (real)(MOTION_quasi_periodic), bounded);
  }
  return lane_select(positive & stays, (real)(MOTION_chaotic), bounded);
}

SHARED_FN void motion_finish(const real* sums, SweepRound round, real* out) {
  const real zero = 0;
  const real undecided = MOTION_undecided;
  const real periodic = MOTION_periodic;
  const MotionGrowth growth = motion_growth(sums + motion_exponent, sums[motion_forcing], round);
  const real without = motion_without_period(sums, growth, round);
  const mask recurs = period_found(sums + motion_recurrence) > zero;
  out[0] = lane_select(recurs, lane_select(growth.grows, undecided, periodic), without);
}
#endif
