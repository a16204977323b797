// Smallest and largest value of a state or signal over the recorded periods: of the steps' ends and
// middles, and of the extremum of the cubic through these where it lies inside a step. At a break
// phase both one-sided values count.

#define EXTREMA_ROLE measure
#define EXTREMA_PER_CHANNEL
// X(suffix of the quantity's name, unit (empty: the channel's), flag meanings, meaning)
#define EXTREMA_OUTPUTS(X)                                   \
  X(min, "", "", "smallest value over the recorded periods") \
  X(max, "", "", "largest value over the recorded periods")  \
  X(peak_to_peak, "", "", "largest less smallest value over the recorded periods")
// X(suffix, role)
#define EXTREMA_OUTPUT_ROLES(X) X(max, peak)

enum { extrema_min, extrema_max, extrema_accumulators };

#ifdef __OPENCL_VERSION__
enum { extrema_outputs = EXTREMA_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void extrema_init(real* sums, real value) {
  sums[extrema_min] = value;
  sums[extrema_max] = value;
}

SHARED_FN void extrema_step(real* sums, real earlier, real before, real middle, real after,
                            const Step* step) {
  const real zero = 0;
  const real low = lane_min(sums[extrema_min], lane_min(before, lane_min(middle, after)));
  const real high = lane_max(sums[extrema_max], lane_max(before, lane_max(middle, after)));
  sums[extrema_min] = low;
  sums[extrema_max] = high;
  const StepCurve curve = step_curve(earlier, before, middle, after, step->cubic);
  // An extremum lies beyond the middle by less than |b| + |c|: where that is not beyond what is
  // known, it need not be looked for.
  const real reach = lane_abs(curve.b) + lane_abs(curve.c);
  const real needed = lane_select(curve.a < zero, high - middle, middle - low);
  const mask counts = step->smooth & step_curve_turns(&curve) & (needed < reach);
  if (all_lanes(!counts)) return;
  const real value = step_curve_at(&curve, step_curve_turn(&curve, counts));
  sums[extrema_min] = lane_select(counts, lane_min(low, value), low);
  sums[extrema_max] = lane_select(counts, lane_max(high, value), high);
}

SHARED_FN void extrema_end_period(real* sums, const Section* section) {}

SHARED_FN void extrema_finish(const real* sums, SweepRound round, real* out) {
  out[0] = sums[extrema_min];
  out[1] = sums[extrema_max];
  out[2] = sums[extrema_max] - sums[extrema_min];
}
#endif
