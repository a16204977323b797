// Poincare samples: chosen states at phase 0, at the end of each recorded period.

#define POINCARE_KIND section
// X(suffix of the quantity's name, unit (empty: the state's), flag meanings, meaning)
#define POINCARE_OUTPUTS(X) X(, "", "", "state at phase 0 of each recorded period")

enum { poincare_accumulators = 0 };

#ifdef __OPENCL_VERSION__
// Writes one sample; series is [sample][chosen state][item], POINCARE_STATES lists the choice.
SHARED_FN void poincare_section(__global real* series, uint sample, uint items, uint item,
                                const real* x) {
#define POINCARE_COUNT(name) +1
#define POINCARE_WRITE(name) series[(size_t)(row++) * items + item] = x[STATE_##name];
  size_t row = (size_t)sample * (0 POINCARE_STATES(POINCARE_COUNT));
  POINCARE_STATES(POINCARE_WRITE)
}
#endif
