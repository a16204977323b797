// How long a motion stays at surfaces, and how often it begins to: dry friction that sticks, a body
// that rests on a wall.

#define STICKING_ROLE measure
#define STICKING_OF_SURFACES
// X(suffix of the quantity's name, unit (/period: how often), flag meanings, meaning)
#define STICKING_OUTPUTS(X)                                                                       \
  X(share, "1", "", "share of the time in which the motion stays at a surface: sticks, or rests") \
  X(stops, "/period", "", "times that it begins to stay at one")

enum { sticking_time, sticking_count, sticking_was, sticking_accumulators };

#ifdef __OPENCL_VERSION__
enum { sticking_outputs = STICKING_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void sticking_init(real* sums, const Instant* start) {
  for (int i = 0; i < sticking_accumulators; ++i) sums[i] = 0;
}

// What stays where the record begins has begun before.
SHARED_FN void sticking_step(real* sums, const Step* step) {
  const real zero = 0;
  const real one = 1;
  const real two = 2;
  const real was = sums[sticking_was];  // 2 where it stayed, 1 where it did not, 0 at the beginning
  const mask moves = zero < step->share;
  const mask begins = moves & step->stays & (was == one);
  sums[sticking_time] = sums[sticking_time] + lane_select(step->stays, step->weight, zero);
  sums[sticking_count] =
      lane_select(begins, sums[sticking_count] + step->once, sums[sticking_count]);
  sums[sticking_was] = lane_select(moves, lane_select(step->stays, two, one), was);
}

SHARED_FN void sticking_end_period(real* sums, const Section* section) {}

SHARED_FN void sticking_finish(const real* sums, SweepRound round, real* out) {
  // Rounding of the sum makes no more than all of it.
  out[0] = lane_min(sums[sticking_time] / (scalar)(round.record), (real)(1));
  out[1] = sums[sticking_count] / (scalar)(round.record);
}
#endif
