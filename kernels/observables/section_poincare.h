// Poincare samples at a section: chosen states where the motion comes up through it. So many are
// kept as there are recorded periods; the host writes SAMPLED_STATES, as for poincare.h, and
// SAMPLED_AT_SECTION. Those that the motion does not come to are no numbers.

#define SECTION_POINCARE_ROLE samples
#define SECTION_POINCARE_PER_SECTION
// X(suffix of the quantity's name, unit (empty: the state's), flag meanings, meaning)
#define SECTION_POINCARE_OUTPUTS(X) X(poincare, "", "", "state at each return to the section")

enum {
  section_poincare_level,  // of the section, where the last step ended (observers_sections)
  section_poincare_count,
  section_poincare_accumulators
};

#ifdef __OPENCL_VERSION__
enum { section_poincare_outputs = 0 };  // of the finished record

SHARED_FN void section_poincare_init(real* sums, const Instant* start) {
  sums[section_poincare_level] = INFINITY;
  sums[section_poincare_count] = 0;
}

SHARED_FN void section_poincare_step(real* sums, const SectionCrossing* crossing,
                                     const Step* step) {
  const real one = 1;
  const int states[] = SAMPLED_STATES;
  const uint chosen = sizeof states / sizeof states[0];
  const Series* series = step->series;
  const real count = sums[section_poincare_count];
  sums[section_poincare_level] = crossing->last;
  if (all_lanes(!crossing->where)) return;
  sums[section_poincare_count] = lane_select(crossing->where, count + one, count);
  // Each lane has come here a number of times of its own.
  for (uint lane = 0; lane < LANES; ++lane) {
    const uint number = (uint)(LANE(count, lane));
    if (!LANE(crossing->where, lane) || number >= series->samples) continue;
    for (uint i = 0; i < chosen; ++i) {
      const size_t at = ((size_t)number * chosen + i) * series->items + series->item;
      SCALARS(series->numbers)[at * LANES + lane] = LANE(crossing->x[states[i]], lane);
    }
  }
}

SHARED_FN void section_poincare_end_period(real* sums, const Section* section) {}

SHARED_FN void section_poincare_finish(const real* sums, SweepRound round, real* out) {}
#endif
