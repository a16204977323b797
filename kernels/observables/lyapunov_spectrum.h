// All Lyapunov exponents (natural logarithm, per dimensionless time) over the recorded periods, the
// largest first. A short record may not tell which tangent vector has which of two that are nearly
// equal, so they are sorted. The zero exponents of phases are not
// counted.

#define LYAPUNOV_SPECTRUM_ROLE verdict
#define LYAPUNOV_SPECTRUM_TANGENTS PER_STATE
#define LYAPUNOV_SPECTRUM_DIMENSION "exponent"
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define LYAPUNOV_SPECTRUM_OUTPUTS(X) X(, "1/tau", "", "Lyapunov exponents")
#define LYAPUNOV_SPECTRUM_OUTPUT_ROLES(X) X(, exponents)

enum { lyapunov_spectrum_accumulators = PER_STATE };

#ifdef __OPENCL_VERSION__
enum { lyapunov_spectrum_outputs = PER_STATE };

SHARED_FN void lyapunov_spectrum_init(real* sums, const Instant* start) {
  for (int j = 0; j < TANGENTS; ++j) sums[j] = 0;
}

SHARED_FN void lyapunov_spectrum_step(real* sums, const Step* step) {}

SHARED_FN void lyapunov_spectrum_end_period(real* sums, const Section* section) {
  const Share weight = period_weight(section);
  for (int j = 0; j < TANGENTS; ++j) {
    sums[j] += weight * (section->log_stretching[j] / section->period);
  }
}

SHARED_FN void lyapunov_spectrum_finish(const real* sums, SweepRound round, real* out) {
  for (int j = 0; j < TANGENTS; ++j) out[j] = sums[j] / (scalar)(round.record);
  for (int pass = 1; pass < TANGENTS; ++pass) {
    for (int j = 0; j + 1 < TANGENTS; ++j) {
      const real high = lane_max(out[j], out[j + 1]);
      out[j + 1] = lane_min(out[j], out[j + 1]);
      out[j] = high;
    }
  }
}
#endif
