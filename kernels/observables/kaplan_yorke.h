// Kaplan-Yorke dimension from all Lyapunov exponents: j + (l_1 + ... + l_j)/|l_(j+1)|, j the
// largest number of exponents whose sum is not negative (Kaplan and Yorke 1979). The phase is not
// a state here: for a phase-driven model this is the dimension of the section. The phase of a
// second frequency is in the section, and its exponent, 0, adds 1.
#include "observables/lyapunov_spectrum.h"

#define KAPLAN_YORKE_ROLE verdict
#define KAPLAN_YORKE_TANGENTS PER_STATE
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define KAPLAN_YORKE_OUTPUTS(X) \
  X(, "1", "",                  \
    "Kaplan-Yorke dimension: of the section at phase 0, without forcing of the attractor")
#define KAPLAN_YORKE_OUTPUT_ROLES(X) X(, exponents)

enum { kaplan_yorke_accumulators = lyapunov_spectrum_accumulators };

#ifdef __OPENCL_VERSION__
enum { kaplan_yorke_outputs = 1 };

SHARED_FN void kaplan_yorke_init(real* sums, const Instant* start) {
  lyapunov_spectrum_init(sums, start);
}

SHARED_FN void kaplan_yorke_step(real* sums, const Step* step) {}

SHARED_FN void kaplan_yorke_end_period(real* sums, const Section* section) {
  lyapunov_spectrum_end_period(sums, section);
}

SHARED_FN void kaplan_yorke_finish(const real* sums, SweepRound round, real* out) {
  const real zero = 0;
  const real one = 1;
  real exponents[TANGENTS];
  lyapunov_spectrum_finish(sums, round, exponents);
  real dimension = MODEL_CLOCKS;
  real sum = 0;
  real counting = 1;  // 0 once the sum has become negative
  for (int j = 0; j < TANGENTS; ++j) {
    const real next = sum + exponents[j];
    const real part = lane_select(next < zero, sum / lane_abs(exponents[j]), one);
    dimension = dimension + counting * part;
    counting = lane_select(next < zero, zero, counting);
    sum = next;
  }
  out[0] = dimension;
}
#endif
