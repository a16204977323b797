// After how many returns to a section the full state recurs (recurrence.h), and the time that
// takes: the period of a cycle, with a clock or without one. The ranges that states are compared by
// are those of the motion since the reference: what decays towards rest does not repeat.
#include "recurrence.h"

#define CYCLE_ROLE statistic
#define CYCLE_PER_SECTION
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define CYCLE_OUTPUTS(X)                                                                \
  X(period, "1", "", "returns to the section after which the motion repeats; 0: none")  \
  X(cycle_time, "tau", "", "time after which the motion repeats; not a number of none") \
  X(settling_time, "tau", "",                                                           \
    "time until the motion stayed periodic; not a number where it did not")

enum {
  cycle_level,      // of the section, where the last step ended (observers_sections)
  cycle_since,      // the last return, or the record's beginning; all times in periods
  cycle_mark,       // from the last recurrence, or the reference, to the last return
  cycle_reference,  // from the reference to the last return
  cycle_total,      // of the candidate's recurrences that are counted
  cycle_turns,      // their number
  cycle_last,       // from the record's beginning to the last return
  cycle_begun,      // and to the candidate's first reference
  cycle_forcing,    // the forcing's period, in dimensionless time
  cycle_low,        // of each state, in the record
  cycle_high = cycle_low + PER_STATE,
  cycle_near_low = cycle_high + PER_STATE,  // since the reference
  cycle_near_high = cycle_near_low + PER_STATE,
  cycle_recurrence = cycle_near_high + PER_STATE,
  cycle_accumulators = (int)(cycle_recurrence) + (int)(recurrence_accumulators)
};

#ifdef __OPENCL_VERSION__
enum { cycle_outputs = CYCLE_OUTPUTS(COUNT_OUTPUT) };
enum { cycle_longest_window = 64 };  // returns

SHARED_FN void cycle_init(real* sums, const Instant* start) {
  for (int i = 0; i < cycle_low; ++i) sums[i] = 0;
  sums[cycle_level] = INFINITY;
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[cycle_low + i] = start->x[i];
    sums[cycle_high + i] = start->x[i];
    sums[cycle_near_low + i] = start->x[i];
    sums[cycle_near_high + i] = start->x[i];
  }
  recurrence_init(sums + cycle_recurrence);
}

SHARED_FN void cycle_step(real* sums, const SectionCrossing* crossing, const Step* step) {
  const real zero = 0;
  const real one = 1;
  // Not a number from where the level is none, or infinite, on.
  const real whole = sums[cycle_since] + step->share + zero * crossing->last;
  const mask counts = crossing->where;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real x = step->after->x[i];
    sums[cycle_low + i] = lane_min(sums[cycle_low + i], x);
    sums[cycle_high + i] = lane_max(sums[cycle_high + i], x);
    sums[cycle_near_low + i] = lane_min(sums[cycle_near_low + i], x);
    sums[cycle_near_high + i] = lane_max(sums[cycle_near_high + i], x);
  }
  sums[cycle_level] = crossing->last;
  sums[cycle_since] = whole;
  if (all_lanes(!counts)) return;
  Extent extent;
  real ranges[MODEL_STATE_COUNT];
  real shared[MODEL_STATE_COUNT];
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    extent.low[i] = sums[cycle_near_low + i];
    extent.high[i] = sums[cycle_near_high + i];
    extent.made[i] = 0;
  }
  extent_ranges(&extent, (scalar)(PERIOD_TOLERANCE), ranges);
  share_ranges(ranges, shared);
  const Recurred done =
      recurrence_see(sums + cycle_recurrence, counts, crossing->x, shared, cycle_longest_window);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real x = crossing->x[i];
    sums[cycle_near_low + i] = lane_select(done.moved, x, sums[cycle_near_low + i]);
    sums[cycle_near_high + i] = lane_select(done.moved, x, sums[cycle_near_high + i]);
  }
  const real time = lane_select(counts, whole - (one - crossing->share) * step->share, zero);
  const real mark = sums[cycle_mark] + time;
  const real reference = sums[cycle_reference] + time;
  const real last = sums[cycle_last] + time;
  sums[cycle_begun] = lane_select(done.fresh, last - reference, sums[cycle_begun]);
  sums[cycle_last] = last;
  const real total = lane_select(done.hit, sums[cycle_total] + mark, sums[cycle_total]);
  const real turns = lane_select(done.hit, sums[cycle_turns] + one, sums[cycle_turns]);
  sums[cycle_total] = lane_select(done.fresh, reference, total);
  sums[cycle_turns] = lane_select(done.fresh, one, turns);
  sums[cycle_mark] = lane_select(done.hit | done.fresh | done.moved, zero, mark);
  sums[cycle_reference] = lane_select(done.moved, zero, reference);
  sums[cycle_since] = lane_select(counts, whole - time, whole);
}

SHARED_FN void cycle_end_period(real* sums, const Section* section) {
  sums[cycle_forcing] = section->period;
}

SHARED_FN void cycle_finish(const real* sums, SweepRound round, real* out) {
  const real zero = 0;
  const real period = recurrence_found(sums + cycle_recurrence);
  const real time = sums[cycle_forcing] * (sums[cycle_total] / sums[cycle_turns]);
  // From the reference of the recurrences on it was periodic.
  const real settled = (scalar)(round.settled) + sums[cycle_begun];
  const mask is_defined = sums[cycle_since] == sums[cycle_since];
  const mask repeats = is_defined & (zero < period);
  out[0] = lane_select(is_defined, period, (real)(NAN));
  out[1] = lane_select(repeats, time, (real)(NAN));
  out[2] = lane_select(repeats, sums[cycle_forcing] * settled, (real)(NAN));
}
#endif
