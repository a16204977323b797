// The box around the section: smallest and largest value of each state at phase 0 over the record.

#define SECTION_ROLE verdict
#define SECTION_DIMENSION "component"
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define SECTION_OUTPUTS(X)                                                        \
  X(min, "", "", "smallest value at phase 0 of each state, in the model's order") \
  X(max, "", "", "largest value at phase 0 of each state, in the model's order")
// X(suffix, role)
#define SECTION_OUTPUT_ROLES(X) X(min, section_min) X(max, section_max)

enum { section_accumulators = 2 * PER_STATE };

#ifdef __OPENCL_VERSION__
enum { section_outputs = 2 * PER_STATE };

SHARED_FN void section_init(real* sums, const Instant* start) {
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[i] = start->x[i];
    sums[MODEL_STATE_COUNT + i] = start->x[i];
  }
}

SHARED_FN void section_step(real* sums, const Step* step) {}

SHARED_FN void section_end_period(real* sums, const Section* section) {
  const real* x = section->x;
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    sums[i] = lane_min(sums[i], x[i]);
    sums[MODEL_STATE_COUNT + i] = lane_max(sums[MODEL_STATE_COUNT + i], x[i]);
  }
}

SHARED_FN void section_finish(const real* sums, SweepRound round, real* out) {
  for (int i = 0; i < section_outputs; ++i) out[i] = sums[i];
}
#endif
