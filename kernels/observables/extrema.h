// Smallest and largest value of a state or signal over the recorded periods: of the steps' ends and
// middles, and of the extremum of the cubic through these where it lies inside a step. At a break
// phase both one-sided values count.

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

SHARED_FN void extrema_step(real* sums, real earlier, real before, real middle, real after,
                            const Step* step) {
  const real one_half = (scalar)(0.5);
  const real two = 2;
  const real zero = 0;
  const real one = 1;
  const real low = lane_min(sums[extrema_min], lane_min(before, lane_min(middle, after)));
  const real high = lane_max(sums[extrema_max], lane_max(before, lane_max(middle, after)));
  sums[extrema_min] = low;
  sums[extrema_max] = high;
  // middle + b t + a t^2 + c (t^3 - t), where t is -1 at the step's start and 1 at its end. Its
  // slope changes sign between them when |b + 2 c| < 2 |a|; it strays from the parabola without b
  // and c by less than |b| + |c|.
  const real a = one_half * ((before - middle) + (after - middle));
  const real b = one_half * (after - before);
  const real c = step->cubic * ((after - earlier) + (scalar)(3) * (before - middle));
  const real stray = lane_abs(b) + lane_abs(c);
  const real nearest = lane_select(a < zero, high - middle, middle - low);
  const mask counts =
      step->smooth & (lane_abs(b + two * c) < two * lane_abs(a)) & (nearest < stray);
  if (all_lanes(!counts)) return;
  const real square = a * a - (scalar)(3) * c * (b - c);
  const real root = lane_sqrt(lane_max(square, zero));
  const real sum = lane_select(a < zero, a - root, a + root);
  const real t = (c - b) / lane_select(counts, sum, one);
  const real value = middle + t * (b + a * t + c * (t * t - one));
  sums[extrema_min] = lane_select(counts, lane_min(low, value), low);
  sums[extrema_max] = lane_select(counts, lane_max(high, value), high);
}

SHARED_FN void extrema_end_period(real* sums, const Section* section) {}

SHARED_FN void extrema_finish(const real* sums, SweepRound round, real* out) {
  out[0] = sums[extrema_min];
  out[1] = sums[extrema_max];
}
#endif
