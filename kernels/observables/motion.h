// What kind of motion it is, from two witnesses: whether the full state at phase 0 recurs
// (observables/period.h) and the largest Lyapunov exponent (observables/lyapunov_max.h).
//   periodic        a period, and an exponent that is not positive beyond its error;
//   chaotic         no period, and an exponent that is positive beyond its error;
//   quasi_periodic  no period, an exponent that is zero within its error, and a section whose
//                   extent differs by no more than a quarter between the record's halves;
//   undecided       all else: witnesses that contradict each other, a slow transient, a period
//                   beyond the longest, chaos too weak for the record.
// The error is three standard errors. A perturbation that neither grows nor decays in the long run
// still varies while it is carried round; what it grew by over the whole record counts as nothing
// up to a factor exp(2), beyond which the motion is not quasi-periodic whatever the error.
#include "observables/lyapunov_max.h"
#include "observables/period.h"

#define MOTION_KIND orbit
#define MOTION_TANGENTS 1
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define MOTION_OUTPUTS(X)                                   \
  X(class, "", "undecided periodic quasi_periodic chaotic", \
    "kind of motion, by recurrence and largest Lyapunov exponent")

enum {
  motion_forcing,    // the forcing period
  motion_extent,     // of the section in the first half: the greatest range of any component
  motion_recurrence  // then: the accumulators of period and lyapunov_max, the present half's range
};
enum { motion_growth = (int)(motion_recurrence) + (int)(period_accumulators) };
enum { motion_least = (int)(motion_growth) + (int)(lyapunov_max_accumulators) };
enum { motion_greatest = motion_least + PER_STATE };
enum { motion_accumulators = motion_greatest + PER_STATE };

#ifdef __OPENCL_VERSION__
enum { motion_outputs = MOTION_OUTPUTS(COUNT_OUTPUT) };
enum { motion_undecided, motion_periodic, motion_quasi_periodic, motion_chaotic };

SHARED_FN void motion_begin_half(real* sums, const real* x) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[motion_least + i] = x[i];
    sums[motion_greatest + i] = x[i];
  }
}

SHARED_FN real motion_present_extent(const real* sums) {
  real extent = 0;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    extent = lane_max(extent, sums[motion_greatest + i] - sums[motion_least + i]);
  }
  return extent;
}

SHARED_FN void motion_init(real* sums, const real* x) {
  sums[motion_forcing] = 0;
  sums[motion_extent] = 0;
  period_init(sums + motion_recurrence, x);
  lyapunov_max_init(sums + motion_growth);
  motion_begin_half(sums, x);
}

SHARED_FN void motion_period(real* sums, const real* x, const real* growth, real period,
                             uint number, uint record) {
  sums[motion_forcing] = period;
  period_period(sums + motion_recurrence, x, growth, period, number, record);
  lyapunov_max_period(sums + motion_growth, growth, period, number, record);
  if (number == record / 2) {
    sums[motion_extent] = motion_present_extent(sums);
    motion_begin_half(sums, x);
  }
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[motion_least + i] = lane_min(sums[motion_least + i], x[i]);
    sums[motion_greatest + i] = lane_max(sums[motion_greatest + i], x[i]);
  }
}

SHARED_FN void motion_finish(const real* sums, uint record, real* out) {
  const real zero = 0;
  real exponent[lyapunov_max_outputs];
  lyapunov_max_finish(sums + motion_growth, record, exponent);
  const real error = (scalar)(3) * exponent[1];
  const real spare = (scalar)(2) / ((scalar)(record)*sums[motion_forcing]);
  const mask recurs = period_found(sums + motion_recurrence, record) > zero;
  const mask positive = (exponent[0] > error) & (exponent[0] > spare);
  const mask neutral = (lane_abs(exponent[0]) <= error) & (lane_abs(exponent[0]) <= spare);
  const real early = sums[motion_extent];
  const real late = motion_present_extent(sums);
  const mask steady = (late <= (scalar)(1.25) * early) & (early <= (scalar)(1.25) * late);

  const real undecided = motion_undecided;
  const real periodic = lane_select(positive, undecided, (real)(motion_periodic));
  const real quasi_periodic =
      lane_select(neutral & steady, (real)(motion_quasi_periodic), undecided);
  const real other = lane_select(positive, (real)(motion_chaotic), quasi_periodic);
  out[0] = lane_select(recurs, periodic, other);
}
#endif
