// Whether a sequence of states repeats, and after how many: each is compared with a reference that
// moves on after 1, 2, 4, ... states (R. P. Brent, BIT 20 (1980) 176-184) and at last each time the
// longest window is full. Two states are the same when no component differs by more than
// PERIOD_TOLERANCE times the range of the motion, which knows nothing of offsets and units. A
// period counts when, from some reference to the end, all its multiples recur and nothing between
// them does: at least two of them, and for a quarter of the sequence or more. The longest that
// counts is half a window.
//
// A motion that still nears its orbit from alternating sides comes closer to itself after two of
// its periods than after one, for as long as it moves: it would count with the double (a rotating
// approach with another multiple). But then what is missed between is of the size of that approach,
// and so is what the recurrences still lack. Therefore a period counts only when nothing before or
// between its multiples is nearer than PERIOD_CLEAR times the worst of them; what is not as clear
// as that stays open. A ratio of two distances: neither units nor offsets nor scales matter.
#ifndef GEARSWEEP_RECURRENCE_H
#define GEARSWEEP_RECURRENCE_H

enum {
  recurrence_candidate,       // 0: none
  recurrence_hits,            // times that the candidate recurred
  recurrence_due,             // lag at which it recurs next
  recurrence_since,           // states before its reference
  recurrence_worst,           // largest distance of its recurrences
  recurrence_nearest,         // smallest distance of all else since then
  recurrence_window_nearest,  // and in this window
  recurrence_closest,         // smallest distance of all
  recurrence_number,          // states seen behind the first
  recurrence_lag,             // since the reference
  recurrence_window,          // 0: there is no reference yet
  recurrence_reference,       // the state to compare with
  recurrence_accumulators = recurrence_reference + PER_STATE
};

#ifdef __OPENCL_VERSION__
// Settled recurrences are worse by rounding alone, 1e-9 of what they must be told from and less.
#define PERIOD_CLEAR 100

SHARED_FN uint recurrence_longest_window(uint count) {
  uint window = 64;
  while (6 * window <= count) window *= 2;
  return window;
}

SHARED_FN void recurrence_init(real* sums) {
  for (int i = 0; i < recurrence_accumulators; ++i) sums[i] = 0;
  sums[recurrence_nearest] = INFINITY;
  sums[recurrence_window_nearest] = INFINITY;
  sums[recurrence_closest] = INFINITY;
}

SHARED_FN void recurrence_begin(real* sums, const real* x) {
  sums[recurrence_window] = 1;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) sums[recurrence_reference + i] = x[i];
}

// What a state has done.
typedef struct {
  mask hit;    // the candidate recurred
  mask fresh;  // it is a new candidate's first recurrence
  mask moved;  // it is the reference from now on
} Recurred;

// The next state, in the lanes of `where`. ranges: of the motion, for each state.
SHARED_FN Recurred recurrence_see(real* sums, mask where, const real* x, const real* ranges,
                                  uint longest) {
  const real zero = 0;
  const real one = 1;
  const real two = 2;
  const real most = (scalar)(longest);
  const real window = sums[recurrence_window];
  const mask compares = where & (zero < window);
  const real number = lane_select(compares, sums[recurrence_number] + one, sums[recurrence_number]);
  const real now = sums[recurrence_lag] + one;
  real apart[MODEL_STATE_COUNT];
  relative_difference(x, sums + recurrence_reference, ranges, apart);
  const real distance = max_size(apart);
  const mask same = compares & (distance <= (scalar)(PERIOD_TOLERANCE));
  const mask due = sums[recurrence_due] == now;
  Recurred done;
  done.hit = due & same;
  const mask missed = compares & due & !same;
  sums[recurrence_hits] = lane_select(done.hit, sums[recurrence_hits] + one, sums[recurrence_hits]);
  sums[recurrence_worst] =
      lane_select(done.hit, lane_max(sums[recurrence_worst], distance), sums[recurrence_worst]);
  sums[recurrence_due] =
      lane_select(done.hit, now + sums[recurrence_candidate], sums[recurrence_due]);
  sums[recurrence_candidate] = lane_select(missed, zero, sums[recurrence_candidate]);
  sums[recurrence_due] = lane_select(missed, zero, sums[recurrence_due]);
  const mask is_short = compares & (two * now <= most);
  sums[recurrence_closest] =
      lane_select(is_short, lane_min(sums[recurrence_closest], distance), sums[recurrence_closest]);
  const real beside = lane_select(same | !is_short, (real)(INFINITY), distance);
  sums[recurrence_nearest] = lane_min(sums[recurrence_nearest], beside);
  sums[recurrence_window_nearest] = lane_min(sums[recurrence_window_nearest], beside);
  done.fresh = is_short & same &
               ((sums[recurrence_candidate] == zero) | ((now < sums[recurrence_due]) & !done.hit));
  sums[recurrence_candidate] = lane_select(done.fresh, now, sums[recurrence_candidate]);
  sums[recurrence_hits] = lane_select(done.fresh, one, sums[recurrence_hits]);
  sums[recurrence_worst] = lane_select(done.fresh, distance, sums[recurrence_worst]);
  sums[recurrence_nearest] =
      lane_select(done.fresh, sums[recurrence_window_nearest], sums[recurrence_nearest]);
  sums[recurrence_due] = lane_select(done.fresh, now + now, sums[recurrence_due]);
  sums[recurrence_since] = lane_select(done.fresh, number - now, sums[recurrence_since]);
  sums[recurrence_number] = number;
  done.moved = where & (window <= now);
  sums[recurrence_lag] =
      lane_select(done.moved, zero, lane_select(where, now, sums[recurrence_lag]));
  if (all_lanes(!done.moved)) return done;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[recurrence_reference + i] = lane_select(done.moved, x[i], sums[recurrence_reference + i]);
  }
  sums[recurrence_window] =
      lane_select(done.moved, lane_max(one, lane_min(two * window, most)), window);
  sums[recurrence_due] = lane_select(done.moved, sums[recurrence_candidate], sums[recurrence_due]);
  sums[recurrence_window_nearest] =
      lane_select(done.moved, (real)(INFINITY), sums[recurrence_window_nearest]);
  return done;
}

// The period, 0 where none counts.
SHARED_FN real recurrence_found(const real* sums) {
  const real zero = 0;
  const real four = 4;
  const real number = sums[recurrence_number];
  const real held = number - sums[recurrence_since];
  const mask counts = (sums[recurrence_hits] >= (scalar)(2)) & (four * held >= number);
  const mask clear = sums[recurrence_nearest] >= (scalar)(PERIOD_CLEAR)*sums[recurrence_worst];
  return lane_select(counts & clear, sums[recurrence_candidate], zero);
}
#endif
#endif
