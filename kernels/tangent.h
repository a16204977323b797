// Tangent vectors that travel with a state: w is [TANGENTS][MODEL_STATE_COUNT], kept orthonormal by
// the modified Gram-Schmidt method, whose norms give the Lyapunov exponents (Benettin, Galgani,
// Giorgilli, Strelcyn, Meccanica 15 (1980) 9-30). A phase-driven model's phase is no state, so its
// zero exponent is not among them. With TANGENTS 0 nothing is computed.

// Vectors are made orthonormal at the end of each period, and every TANGENT_EVERY steps of long
// segments: otherwise rounding errors of the longest vector would exceed the shortest.
#define TANGENT_EVERY 64
#define TANGENT_IS_DUE(step, is_period_end) (((step) + 1) % TANGENT_EVERY == 0 || (is_period_end))

// Sizes of arrays. An array must not have 0 elements.
#define TANGENT_VECTORS (TANGENTS > 0 ? TANGENTS : 1)
#define TANGENT_NUMBERS (TANGENT_VECTORS * MODEL_STATE_COUNT)

// A motion that begins to slide along a surface loses what tangent vectors have across it, and one
// that is reset what the reset writes over. The vector that is lost is 0 from then on, and its
// exponent minus infinity.
#ifdef MODEL_SURFACES
#define TANGENT_LOST ((scalar)(REAL_BITS == 64 ? 1.4e-14 : 7.6e-6))  // 64 roundings

SHARED_FN real tangent_inverse(real length) {
  const real zero = 0;
  const real one = 1;
  return lane_select(zero < length, one / length, zero);
}
#else
SHARED_FN real tangent_inverse(real length) {
  const real one = 1;
  return one / length;
}
#endif

// The size of its largest component.
SHARED_FN real tangent_size(const real* w) {
  real largest = lane_abs(w[0]);
  for (int i = 1; i < MODEL_STATE_COUNT; ++i) largest = lane_max(largest, lane_abs(w[i]));
  return largest;
}

// Divides a vector by its largest component, and returns that component. After it no square of a
// component overflows or underflows in fp32.
SHARED_FN real tangent_tame(real* w) {
  const real largest = tangent_size(w);
  const real scale = tangent_inverse(largest);
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) w[i] = w[i] * scale;
  return largest;
}

// Makes the vectors orthonormal, and adds the logarithm of each vector's stretching. Only the loops
// over pairs of vectors are unrolled, since they take most of the time. With the others unrolled,
// too, the compiler would keep a single vector in the registers that the step of the state needs.
// slid: the motion may have begun to slide, or been reset, since the last time.
SHARED_FN void tangent_orthonormalize(mask slid, real* w, real* log_stretching) {
#ifdef MODEL_SURFACES
  real before[TANGENT_VECTORS];
  for (int j = 0; j < TANGENTS; ++j) before[j] = tangent_size(w + j * MODEL_STATE_COUNT);
#else
  (void)slid;
#endif
  for (int j = 0; j < TANGENTS; ++j) {
    real* row = w + j * MODEL_STATE_COUNT;
#ifdef MODEL_SURFACES
    const real zero = 0;
    const mask is_lost = slid & (tangent_size(row) < TANGENT_LOST * before[j]);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) row[i] = lane_select(is_lost, zero, row[i]);
#endif
    const real largest = tangent_tame(row);
    real squares = 0;
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) squares = squares + row[i] * row[i];
    // The loop below needs no square root, which takes long.
    const real inverse_square = tangent_inverse(squares);
    for (int k = j + 1; k < TANGENTS; ++k) {
      real* other = w + k * MODEL_STATE_COUNT;
      real product = 0;
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) product = product + row[i] * other[i];
      const real share = product * inverse_square;
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) other[i] = other[i] - share * row[i];
    }
    const real length = lane_sqrt(squares);
    const real inverse = tangent_inverse(length);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) row[i] = row[i] * inverse;
    log_stretching[j] = log_stretching[j] + lane_log(largest * length);
  }
}

#ifndef MODEL_SURFACES
// Advances a state and its tangent vectors by one step; `beside` as in rk4_step.
SHARED_FN void tangent_step(const ModelPoint* point, TABLE PhaseCoefs* stage, real h, int beside,
                            real* x, real* middle, real* w) {
  ModelLinear linear[RK4_EVALUATIONS];
  Crossings crossings;
  rk4_step_linearized(point, stage, h, beside | RK4_LINEAR, x, middle, linear, &crossings);
  // This loop is not unrolled: the registers have room for one vector, not for all.
  for (int j = 0; j < TANGENTS; ++j) {
    real row[MODEL_STATE_COUNT];
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) row[i] = w[j * MODEL_STATE_COUNT + i];
    rk4_tangent_step(point, h, beside, linear, &crossings, row);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) w[j * MODEL_STATE_COUNT + i] = row[i];
  }
}
#endif
