// Period of the motion, in forcing periods: after how many the full state at phase 0 recurs
// (recurrence.h). Windows are of 64 periods, or of the largest power of two that is at most a third
// of the record; ranges are those of the motion during any period so far (items.h).
#include "recurrence.h"

#define PERIOD_ROLE verdict
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define PERIOD_OUTPUTS(X) X(, "1", "", "period in forcing periods; 0: none was found")
// X(suffix, role)
#define PERIOD_OUTPUT_ROLES(X) X(, period)

enum {
  period_recurrence,
  // The largest range of each state during a period.
  period_ranges = (int)(period_recurrence) + (int)(recurrence_accumulators),
  period_accumulators = period_ranges + PER_STATE
};

#ifdef __OPENCL_VERSION__
enum { period_outputs = PERIOD_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void period_init(real* sums, const Instant* start) {
  recurrence_init(sums + period_recurrence);
  recurrence_begin(sums + period_recurrence, start->x);
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) sums[period_ranges + i] = 0;
}

SHARED_FN void period_step(real* sums, const Step* step) {}

SHARED_FN void period_end_period(real* sums, const Section* section) {
  const real zero = 0;
  const mask all = zero == zero;
  real ranges[MODEL_STATE_COUNT];
  real shared[MODEL_STATE_COUNT];
  extent_ranges(section->extent, (scalar)(PERIOD_TOLERANCE), ranges);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[period_ranges + i] = lane_max(sums[period_ranges + i], ranges[i]);
  }
  share_ranges(sums + period_ranges, shared);
  (void)recurrence_see(sums + period_recurrence, all, section->x, shared,
                       recurrence_longest_window(section->record));
}

// The period, 0 where none counts.
SHARED_FN real period_found(const real* sums) { return recurrence_found(sums + period_recurrence); }

SHARED_FN void period_finish(const real* sums, SweepRound round, real* out) {
  out[0] = period_found(sums);
}
#endif
