// How often the motion comes up through a section, and the times from one return to the next.

#define RETURNS_ROLE measure
#define RETURNS_PER_SECTION
// X(suffix of the quantity's name, unit (/period: how often), flag meanings, meaning)
#define RETURNS_OUTPUTS(X)                                                                \
  X(returns, "/period", "", "times that the motion comes through the section")            \
  X(return_time, "tau", "", "mean time from one return to the next; not a number of one") \
  X(return_time_min, "tau", "", "shortest time from one return to the next")              \
  X(return_time_max, "tau", "", "longest time from one return to the next")

enum {
  returns_level,  // of the section, where the last step ended (observers_sections)
  returns_since,  // the last return, or the record's beginning; all times in periods
  returns_count,
  returns_weight,  // what they count in the record's window
  returns_total,   // from the first to the last one
  returns_shortest,
  returns_longest,
  returns_period,  // of the forcing, in dimensionless time
  returns_accumulators
};

#ifdef __OPENCL_VERSION__
enum { returns_outputs = RETURNS_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void returns_init(real* sums, const Instant* start) {
  for (int i = 0; i < returns_accumulators; ++i) sums[i] = 0;
  sums[returns_level] = INFINITY;
  sums[returns_shortest] = INFINITY;
}

SHARED_FN void returns_step(real* sums, const SectionCrossing* crossing, const Step* step) {
  const real zero = 0;
  const real one = 1;
  const mask counts = crossing->where;
  // Not a number from where the level is none, or infinite, on.
  const real whole = sums[returns_since] + step->share + zero * crossing->last;
  sums[returns_level] = crossing->last;
  sums[returns_since] = whole;
  if (all_lanes(!counts)) return;
  const real time = whole - (one - crossing->share) * step->share;
  const mask returns = counts & (zero < sums[returns_count]);
  sums[returns_total] = lane_select(returns, sums[returns_total] + time, sums[returns_total]);
  sums[returns_shortest] =
      lane_select(returns, lane_min(time, sums[returns_shortest]), sums[returns_shortest]);
  sums[returns_longest] =
      lane_select(returns, lane_max(time, sums[returns_longest]), sums[returns_longest]);
  sums[returns_count] = lane_select(counts, sums[returns_count] + one, sums[returns_count]);
  sums[returns_weight] =
      lane_select(counts, sums[returns_weight] + step->once, sums[returns_weight]);
  sums[returns_since] = lane_select(counts, whole - time, whole);
}

SHARED_FN void returns_end_period(real* sums, const Section* section) {
  sums[returns_period] = section->period;
}

SHARED_FN void returns_finish(const real* sums, SweepRound round, real* out) {
  const real one = 1;
  const real nothing = NAN;
  const real count = sums[returns_count];
  const real period = sums[returns_period];
  const mask is_defined = sums[returns_since] == sums[returns_since];
  const mask any = (one < count) & is_defined;
  out[0] = lane_select(is_defined, sums[returns_weight] / (scalar)(round.record), nothing);
  out[1] = lane_select(any, period * (sums[returns_total] / (count - one)), nothing);
  out[2] = lane_select(any, period * sums[returns_shortest], nothing);
  out[3] = lane_select(any, period * sums[returns_longest], nothing);
}
#endif
