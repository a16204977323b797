// Period of the motion, in forcing periods: after how many the full state at phase 0 recurs. The
// state is compared with a reference that moves on after 1, 2, 4, ... periods (R. P. Brent, BIT 20
// (1980) 176-184) and at last each time a window is full: 64 periods, or the largest power of two
// that is at most a third of the record. Two states are the same when no component differs by more
// than PERIOD_TOLERANCE times the range of the motion during any period so far (items.h), which
// knows nothing of offsets and units. A period counts when, from some reference to the end of the
// record, all its multiples recur and nothing between them does: at least two of them, and for a
// quarter of the record or more. The longest that counts is half a window.
//
// A motion that still nears its orbit from alternating sides comes closer to itself after two of
// its periods than after one, for as long as it moves: it would count with the double (a rotating
// approach with another multiple). But then what is missed between is of the size of that approach,
// and so is what the recurrences still lack. Therefore a period counts only when nothing before or
// between its multiples is nearer than PERIOD_CLEAR times the worst of them; what is not as clear
// as that stays open. A ratio of two distances: neither units nor offsets nor scales matter.

#define PERIOD_ROLE verdict
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define PERIOD_OUTPUTS(X) X(, "1", "", "period in forcing periods; 0: none was found")
// X(suffix, role)
#define PERIOD_OUTPUT_ROLES(X) X(, period)

enum {
  period_candidate,                                // 0: none
  period_hits,                                     // times that the candidate recurred
  period_due,                                      // lag at which it recurs next
  period_since,                                    // periods recorded before its reference
  period_worst,                                    // largest distance of its recurrences
  period_nearest,                                  // smallest distance of all else since then
  period_window_nearest,                           // and in this window
  period_reference,                                // the state to compare with
  period_ranges = period_reference + PER_STATE,    // of each state during a period, the largest
  period_accumulators = period_ranges + PER_STATE  // all of them
};

#ifdef __OPENCL_VERSION__
// Settled recurrences are worse by rounding alone, 1e-9 of what they must be told from and less.
#define PERIOD_CLEAR 100

enum { period_outputs = PERIOD_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN uint period_longest_window(uint record) {
  uint window = 64;
  while (6 * window <= record) window *= 2;
  return window;
}

SHARED_FN void period_take_reference(real* sums, const real* x) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) sums[period_reference + i] = x[i];
}

SHARED_FN void period_init(real* sums, const Instant* start) {
  for (int i = 0; i < period_accumulators; ++i) sums[i] = 0;
  sums[period_nearest] = INFINITY;
  sums[period_window_nearest] = INFINITY;
  period_take_reference(sums, start->x);
}

SHARED_FN void period_step(real* sums, const Step* step) {}

SHARED_FN void period_end_period(real* sums, const Section* section) {
  const real* x = section->x;
  const uint number = section->number;
  const uint longest = period_longest_window(section->record);
  uint window = 1;
  uint start = 0;
  while (window < longest && number >= start + window) {
    start += window;
    window *= 2;
  }
  const uint lag = (number - start) % window + 1;
  const real now = (scalar)(lag);
  const real zero = 0;
  const real one = 1;

  real ranges[MODEL_STATE_COUNT];
  real shared[MODEL_STATE_COUNT];
  extent_ranges(section->extent, (scalar)(PERIOD_TOLERANCE), ranges);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[period_ranges + i] = lane_max(sums[period_ranges + i], ranges[i]);
  }
  share_ranges(sums + period_ranges, shared);
  real apart[MODEL_STATE_COUNT];
  relative_difference(x, sums + period_reference, shared, apart);
  const real distance = max_size(apart);
  const mask same = distance <= (scalar)(PERIOD_TOLERANCE);
  const mask due = sums[period_due] == now;
  const mask hit = due & same;
  const mask missed = due & !same;
  sums[period_hits] = lane_select(hit, sums[period_hits] + one, sums[period_hits]);
  sums[period_worst] = lane_select(hit, lane_max(sums[period_worst], distance), sums[period_worst]);
  sums[period_due] = lane_select(hit, now + sums[period_candidate], sums[period_due]);
  sums[period_candidate] = lane_select(missed, zero, sums[period_candidate]);
  sums[period_due] = lane_select(missed, zero, sums[period_due]);
  if (2 * lag <= longest) {
    const real beside = lane_select(same, (real)(INFINITY), distance);
    sums[period_nearest] = lane_min(sums[period_nearest], beside);
    sums[period_window_nearest] = lane_min(sums[period_window_nearest], beside);
    const mask fresh =
        same & ((sums[period_candidate] == zero) | ((now < sums[period_due]) & !hit));
    sums[period_candidate] = lane_select(fresh, now, sums[period_candidate]);
    sums[period_hits] = lane_select(fresh, one, sums[period_hits]);
    sums[period_worst] = lane_select(fresh, distance, sums[period_worst]);
    sums[period_nearest] = lane_select(fresh, sums[period_window_nearest], sums[period_nearest]);
    sums[period_due] = lane_select(fresh, now + now, sums[period_due]);
    sums[period_since] = lane_select(fresh, (real)((scalar)(number + 1 - lag)), sums[period_since]);
  }
  if (lag < window) return;
  period_take_reference(sums, x);
  sums[period_due] = sums[period_candidate];
  sums[period_window_nearest] = INFINITY;
}

// The period, 0 where none counts.
SHARED_FN real period_found(const real* sums, uint record) {
  const real zero = 0;
  const real held = (scalar)(record)-sums[period_since];
  const mask counts = (sums[period_hits] >= (scalar)(2)) & ((scalar)(4) * held >= (scalar)(record));
  const mask clear = sums[period_nearest] >= (scalar)(PERIOD_CLEAR)*sums[period_worst];
  return lane_select(counts & clear, sums[period_candidate], zero);
}

SHARED_FN void period_finish(const real* sums, SweepRound round, real* out) {
  out[0] = period_found(sums, round.record);
}
#endif
