// Largest Lyapunov exponent (natural logarithm, per dimensionless time) over the recorded periods,
// and the error of the estimate, which is the larger of two:
// - The standard error from the spread of its means over 16 blocks of periods. It is that of chaos,
//   whose blocks know little of each other.
// - How far the log stretching strays in the second half of the record from a straight line, which
//   goes on as the first half did, over the length of the record, times LYAPUNOV_MAX_CAUTION. Where
//   a vector varies while it is carried round, or turns into its direction slowly, blocks are alike
//   and wrong together; the error is what the vector varies by, over the time.
// Where there is no clock the record ends anywhere on a cycle. There the exponent looks through the
// record's window (observe.h): on a cycle and on a torus it is much better than this error says, in
// chaos its standard error grows by a fifth.
// The zero exponents of phases are not counted. The host adds to the error of a periodic motion
// what the steps' length and the distance from the orbit make
// (host/tile/detail/exponent_error.hpp).

#define LYAPUNOV_MAX_ROLE verdict
#define LYAPUNOV_MAX_TANGENTS 1
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define LYAPUNOV_MAX_OUTPUTS(X)                                   \
  X(, "1/tau", "", "largest Lyapunov exponent")                   \
  X(error, "1/tau", "", "error of the largest Lyapunov exponent") \
  X(per_period, "1", "", "largest Lyapunov exponent times the forcing period")
// X(suffix, role)
#define LYAPUNOV_MAX_OUTPUT_ROLES(X) \
  X(, exponent) X(error, exponent_error) X(per_period, exponent_per_period)

enum {
  lyapunov_max_sum,         // of the periods' rates: log stretching over time
  lyapunov_max_weighted,    // of the same, as they count in the record's window
  lyapunov_max_stretching,  // of the periods' log stretchings
  lyapunov_max_block,       // of the rates in the running block
  lyapunov_max_origin,      // mean rate of the first block
  lyapunov_max_offsets,     // sum of the blocks' means less the first
  lyapunov_max_squares,     // and of their squares
  lyapunov_max_half,        // mean rate of the first half
  lyapunov_max_strayed,     // sum of the later rates less that
  lyapunov_max_lowest,      // the smallest and the largest value of that sum
  lyapunov_max_highest,
  lyapunov_max_accumulators
};

#ifdef __OPENCL_VERSION__
// Without it 0.7 % of 1,000 random motions of five kinds were off by more than three errors; with
// it 0.2 % were, which lost their chaos after the record.
#define LYAPUNOV_MAX_CAUTION 1.25

enum { lyapunov_max_outputs = LYAPUNOV_MAX_OUTPUTS(COUNT_OUTPUT), lyapunov_max_blocks = 16 };

SHARED_FN void lyapunov_max_init(real* sums, const Instant* start) {
  for (int i = 0; i < lyapunov_max_accumulators; ++i) sums[i] = 0;
}

SHARED_FN void lyapunov_max_step(real* sums, const Step* step) {}

SHARED_FN void lyapunov_max_end_period(real* sums, const Section* section) {
  const uint number = section->number;
  const uint block = max(section->record / lyapunov_max_blocks, 1u);
  const real rate = section->log_stretching[0] / section->period;
  sums[lyapunov_max_sum] += rate;
  sums[lyapunov_max_weighted] += period_weight(section) * rate;
  sums[lyapunov_max_stretching] += section->log_stretching[0];
  sums[lyapunov_max_block] += rate;
  const uint middle = section->record / 2;
  if (number + 1 == middle) sums[lyapunov_max_half] = sums[lyapunov_max_sum] / (scalar)(middle);
  if (number + 1 > middle) {
    const real strayed = sums[lyapunov_max_strayed] + (rate - sums[lyapunov_max_half]);
    sums[lyapunov_max_strayed] = strayed;
    sums[lyapunov_max_lowest] = lane_min(sums[lyapunov_max_lowest], strayed);
    sums[lyapunov_max_highest] = lane_max(sums[lyapunov_max_highest], strayed);
  }
  if ((number + 1) % block != 0) return;
  const real mean = sums[lyapunov_max_block] / (scalar)(block);
  if (number + 1 == block) sums[lyapunov_max_origin] = mean;
  const real offset = mean - sums[lyapunov_max_origin];
  sums[lyapunov_max_offsets] += offset;
  sums[lyapunov_max_squares] += offset * offset;
  sums[lyapunov_max_block] = 0;
}

// The error is not a number when there is only one block.
SHARED_FN void lyapunov_max_finish(const real* sums, SweepRound round, real* out) {
  const scalar blocks = (scalar)(round.record / max(round.record / lyapunov_max_blocks, 1u));
  const real mean = sums[lyapunov_max_offsets] / blocks;
  const real variance = lane_max(sums[lyapunov_max_squares] / blocks - mean * mean, (real)(0));
  const real of_blocks = lane_sqrt((scalar)(WINDOW_SQUARES)*variance / (blocks - 1));
  const real range = sums[lyapunov_max_highest] - sums[lyapunov_max_lowest];
  const real of_straying = (scalar)(LYAPUNOV_MAX_CAUTION)*range / (scalar)(round.record);
  out[0] = sums[lyapunov_max_weighted] / (scalar)(round.record);
  out[1] = lane_select(of_blocks < of_straying, of_straying, of_blocks);
  out[2] = sums[lyapunov_max_stretching] / (scalar)(round.record);
}
#endif
