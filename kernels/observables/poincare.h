// Poincare samples: chosen states at phase 0, at the end of each recorded period. The host writes
// SAMPLED_STATES, their indices as an initialiser.

#define POINCARE_ROLE samples
// X(suffix of the quantity's name, unit (empty: the state's), flag meanings, meaning)
#define POINCARE_OUTPUTS(X) \
  X(, "", "", "state at phase 0 of each recorded period, or at each return to a section")

enum { poincare_accumulators = 0 };

#ifdef __OPENCL_VERSION__
enum { poincare_outputs = 0 };  // of the finished record

SHARED_FN void poincare_init(real* sums, const Instant* start) {}

SHARED_FN void poincare_step(real* sums, const Step* step) {}

SHARED_FN void poincare_end_period(real* sums, const Section* section) {
  const int states[] = SAMPLED_STATES;
  const uint count = sizeof states / sizeof states[0];
  const size_t first = (size_t)section->number * count;
  if (!section->series) return;
  UNROLL
  for (uint i = 0; i < count; ++i) {
    section->series[(first + i) * section->items + section->item] = section->x[states[i]];
  }
}

SHARED_FN void poincare_finish(const real* sums, SweepRound round, real* out) {}
#endif
