// How many periods, settling included, went by before the orbit stayed periodic: those before the
// reference of observables/period.h from which on the period holds. References lie 64 periods
// apart, less at the record's beginning; an orbit that is periodic from there on has settled after
// the periods before the record, or before.
#include "observables/period.h"

#define SETTLED_ROLE verdict
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define SETTLED_OUTPUTS(X) \
  X(, "1", "", "forcing periods until the motion stayed periodic; not a number when it did not")
// X(suffix, role)
#define SETTLED_OUTPUT_ROLES(X) X(, settled)

enum { settled_accumulators = period_accumulators };

#ifdef __OPENCL_VERSION__
enum { settled_outputs = SETTLED_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void settled_init(real* sums, const Instant* start) { period_init(sums, start); }

SHARED_FN void settled_step(real* sums, const Step* step) {}

SHARED_FN void settled_end_period(real* sums, const Section* section) {
  period_end_period(sums, section);
}

SHARED_FN void settled_finish(const real* sums, SweepRound round, real* out) {
  const real zero = 0;
  const real total = sums[period_recurrence + recurrence_since] + (scalar)(round.settled);
  out[0] = lane_select(period_found(sums) > zero, total, (real)(NAN));
}
#endif
