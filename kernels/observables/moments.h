// Mean, RMS and standard deviation of a state or signal over the recorded periods, by Simpson's
// rule over each step of the phase grid. The sums are of the difference to the first value, and
// first over each period, so that they keep their digits in fp32. What a state has lost before, to
// its own rounding, they cannot bring back: a motion smaller than some units in the last place of
// its offset is staggered, or stands still. In fp32 such a motion has no standard deviation.

#define MOMENTS_ROLE measure
#define MOMENTS_PER_CHANNEL
// X(suffix of the quantity's name, unit (empty: the channel's), flag meanings, meaning)
#define MOMENTS_OUTPUTS(X)                                     \
  X(mean, "", "", "time average over the recorded periods")    \
  X(rms, "", "", "root mean square over the recorded periods") \
  X(std, "", "", "standard deviation over the recorded periods; in fp32 none below 1e-5 of the rms")
// X(suffix, role)
#define MOMENTS_OUTPUT_ROLES(X) X(rms, rms)

enum {
  moments_origin,
  moments_sum,
  moments_squares,
  moments_period_sum,
  moments_period_squares,
  moments_accumulators
};

#ifdef __OPENCL_VERSION__
enum { moments_outputs = MOMENTS_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void moments_init(real* sums, real value) {
  sums[moments_origin] = value;
  sums[moments_sum] = 0;
  sums[moments_squares] = 0;
  sums[moments_period_sum] = 0;
  sums[moments_period_squares] = 0;
}

SHARED_FN void moments_step(real* sums, real earlier, real before, real middle, real after,
                            const Step* step) {
  const Share sixth_weight = (scalar)(1.0 / 6.0) * step->weight;
  const scalar four = 4;
  const real a = before - sums[moments_origin];
  const real m = middle - sums[moments_origin];
  const real b = after - sums[moments_origin];
  sums[moments_period_sum] = sums[moments_period_sum] + sixth_weight * ((a + b) + four * m);
  sums[moments_period_squares] =
      sums[moments_period_squares] + sixth_weight * ((a * a + b * b) + four * (m * m));
}

SHARED_FN void moments_end_period(real* sums, const Section* section) {
  sums[moments_sum] += sums[moments_period_sum];
  sums[moments_squares] += sums[moments_period_squares];
  sums[moments_period_sum] = 0;
  sums[moments_period_squares] = 0;
}

SHARED_FN void moments_finish(const real* sums, SweepRound round, real* out) {
  const scalar periods = (scalar)(round.record);
  const real offset = sums[moments_sum] / periods;
  const real mean = sums[moments_origin] + offset;
  const real variance = lane_max(sums[moments_squares] / periods - offset * offset, (real)(0));
  out[0] = mean;
  out[1] = lane_sqrt(mean * mean + variance);
  out[2] = lane_sqrt(variance);
#if REAL_BITS == 32
  // Some hundred units in the last place: rounding makes about ten of them by itself.
  out[2] = lane_select(out[2] < (scalar)(1e-5) * out[1], (real)(NAN), out[2]);
#endif
}
#endif
