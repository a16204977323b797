// Impacts on a surface where the state is reset: how often, and how fast the hardest one comes.
// Those by which a motion comes to rest, ever faster, count too.

#define SURFACE_IMPACTS_ROLE measure
#define SURFACE_IMPACTS_PER_SURFACE
// X(suffix of the quantity's name, unit (/tau: a rate, /period: how often), flag meanings, meaning)
#define SURFACE_IMPACTS_OUTPUTS(X)           \
  X(impacts, "/period", "", "impacts on it") \
  X(impact_speed, "/tau", "", "rate of its expression at the hardest impact; 0 without any")

enum { surface_impacts_count, surface_impacts_hardest, surface_impacts_accumulators };

#ifdef __OPENCL_VERSION__
enum { surface_impacts_outputs = SURFACE_IMPACTS_OUTPUTS(COUNT_OUTPUT) };

SHARED_FN void surface_impacts_init(real* sums, const Instant* start) {
  for (int i = 0; i < surface_impacts_accumulators; ++i) sums[i] = 0;
}

SHARED_FN void surface_impacts_step(real* sums, const Step* step) {}

SHARED_FN void surface_impacts_meet(real* sums, mask hit, real rate, Share once) {
  const real count = sums[surface_impacts_count];
  const real hardest = sums[surface_impacts_hardest];
  sums[surface_impacts_count] = lane_select(hit, count + once, count);
  sums[surface_impacts_hardest] = lane_select(hit, lane_max(hardest, rate), hardest);
}

SHARED_FN void surface_impacts_end_period(real* sums, const Section* section) {}

SHARED_FN void surface_impacts_finish(const real* sums, SweepRound round, real* out) {
  out[0] = sums[surface_impacts_count] / (scalar)(round.record);
  out[1] = sums[surface_impacts_hardest];
}
#endif
