// Smallest and largest value of a state or signal over the recorded periods, taken at the steps'
// ends; at a break phase both one-sided values count.

#define EXTREMA_ROLE measure
#define EXTREMA_PER_CHANNEL
// X(suffix of the quantity's name, unit (empty: the channel's), flag meanings, meaning)
#define EXTREMA_OUTPUTS(X)                                   \
  X(min, "", "", "smallest value over the recorded periods") \
  X(max, "", "", "largest value over the recorded periods")
// X(suffix, role)
#define EXTREMA_OUTPUT_ROLES(X) X(max, peak)

enum { extrema_min, extrema_max, extrema_accumulators };

#ifdef __OPENCL_VERSION__
enum { extrema_outputs = EXTREMA_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void extrema_init(real* sums, real value) {
  sums[extrema_min] = value;
  sums[extrema_max] = value;
}

SHARED_FN void extrema_step(real* sums, real before, real after, scalar weight) {
  sums[extrema_min] = lane_min(sums[extrema_min], lane_min(before, after));
  sums[extrema_max] = lane_max(sums[extrema_max], lane_max(before, after));
}

SHARED_FN void extrema_end_period(real* sums, const Section* section) {}

SHARED_FN void extrema_finish(const real* sums, SweepRound round, real* out) {
  out[0] = sums[extrema_min];
  out[1] = sums[extrema_max];
}
#endif
