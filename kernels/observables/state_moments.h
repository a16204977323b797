// Mean and standard deviation of each state, with their standard errors from the spread of up to 31
// blocks of periods. By these, attractors that are not periodic are told apart
// (host/attractors/): at phase 0 of a forced model, where the section has all of the motion; over
// all of the motion of an autonomous one, whose sections lie anywhere on it. What no block is full
// of is left out, so that a motion whose periods fill the blocks has no error.

#define STATE_MOMENTS_ROLE statistic
#define STATE_MOMENTS_DIMENSION "component"
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define STATE_MOMENTS_OUTPUTS(X)                                                              \
  X(mean, "", "", "mean of each state at phase 0; of an autonomous model over the motion")    \
  X(std, "", "", "standard deviation of each state at phase 0, or over the motion")           \
  X(mean_error, "", "", "standard error of the mean of each state; not a number of 1 period") \
  X(std_error, "", "", "standard error of each state's standard deviation")
// X(suffix, role)
#define STATE_MOMENTS_OUTPUT_ROLES(X) \
  X(mean, state_mean)                 \
  X(std, state_std)                   \
  X(mean_error, state_mean_error)     \
  X(std_error, state_std_error)

// For each state: the value from which it is counted; sums of it and of its square in the running
// block; over the blocks, sums of both means, of their squares and of their product.
enum {
  state_moments_block = PER_STATE,
  state_moments_block_squares = 2 * PER_STATE,
  state_moments_means = 3 * PER_STATE,
  state_moments_squares = 4 * PER_STATE,
  state_moments_means_twice = 5 * PER_STATE,
  state_moments_squares_twice = 6 * PER_STATE,
  state_moments_products = 7 * PER_STATE,
  state_moments_accumulators = 8 * PER_STATE
};

#ifdef __OPENCL_VERSION__
enum { state_moments_outputs = 4 * PER_STATE, state_moments_blocks = 16 };

SHARED_FN uint state_moments_length(uint record) { return max(record / state_moments_blocks, 1u); }

SHARED_FN void state_moments_init(real* sums, const Instant* start) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) sums[i] = start->x[i];
  for (int i = state_moments_block; i < state_moments_accumulators; ++i) sums[i] = 0;
}

SHARED_FN void state_moments_add(real* sums, const real* x, Share weight) {
  real at[MODEL_STATE_COUNT];
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) at[i] = x[i];
  model_take_turns(at);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real offset = at[i] - sums[i];
    sums[state_moments_block + i] += weight * offset;
    sums[state_moments_block_squares + i] += weight * offset * offset;
  }
}

// By Simpson's rule.
SHARED_FN void state_moments_step(real* sums, const Step* step) {
#ifdef MODEL_AUTONOMOUS
  const Share sixth = (scalar)(1.0 / 6.0) * step->share;
  state_moments_add(sums, step->before->x, sixth);
  state_moments_add(sums, step->middle->x, (scalar)(4) * sixth);
  state_moments_add(sums, step->after->x, sixth);
#endif
}

SHARED_FN void state_moments_end_period(real* sums, const Section* section) {
#ifndef MODEL_AUTONOMOUS
  state_moments_add(sums, section->x, (scalar)(1));
#endif
  const uint length = state_moments_length(section->record);
  if ((section->number + 1) % length != 0) return;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real mean = sums[state_moments_block + i] / (scalar)(length);
    const real square = sums[state_moments_block_squares + i] / (scalar)(length);
    sums[state_moments_means + i] += mean;
    sums[state_moments_squares + i] += square;
    sums[state_moments_means_twice + i] += mean * mean;
    sums[state_moments_squares_twice + i] += square * square;
    sums[state_moments_products + i] += mean * square;
    sums[state_moments_block + i] = 0;
    sums[state_moments_block_squares + i] = 0;
  }
}

// The square about the mean m changes with the square about the origin, and with the mean by -2 m.
SHARED_FN void state_moments_finish(const real* sums, SweepRound round, real* out) {
  const scalar blocks = (scalar)(round.record / state_moments_length(round.record));
  const real zero = 0;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real mean = sums[state_moments_means + i] / blocks;
    const real square = sums[state_moments_squares + i] / blocks;
    const real spread = sums[state_moments_means_twice + i] / blocks - mean * mean;
    const real square_spread = sums[state_moments_squares_twice + i] / blocks - square * square;
    const real together = sums[state_moments_products + i] / blocks - mean * square;
    const real turn = (scalar)(2) * mean;
    const real variance_spread =
        square_spread - (scalar)(2) * turn * together + turn * turn * spread;
    const real deviation = lane_sqrt(lane_max(square - mean * mean, zero));
    const real error = lane_sqrt(lane_max(variance_spread, zero) / (blocks - (scalar)(1)));
    out[i] = sums[i] + mean;
    out[MODEL_STATE_COUNT + i] = deviation;
    out[2 * MODEL_STATE_COUNT + i] = lane_sqrt(lane_max(spread, zero) / (blocks - (scalar)(1)));
    out[3 * MODEL_STATE_COUNT + i] =
        lane_select(zero < deviation, error / ((scalar)(2) * deviation), zero);
  }
}
#endif
