// Tangent vectors that travel with a state: w is [TANGENTS][MODEL_STATE_COUNT], kept orthonormal by
// the modified Gram-Schmidt method, whose norms give the Lyapunov exponents (Benettin, Galgani,
// Giorgilli, Strelcyn, Meccanica 15 (1980) 9-30). A phase-driven model's phase is no state, so its
// zero exponent is not among them. With TANGENTS 0 all of this is nothing.

// Vectors are made orthonormal at the end of each segment of a period, and more often in long ones:
// the shortest must not drown in the longest.
#define TANGENT_EVERY 64
#define TANGENT_IS_DUE(step, steps) (((step) + 1) % TANGENT_EVERY == 0 || (step) + 1 == (steps))

// Array sizes, which must not be 0.
#define TANGENT_VECTORS (TANGENTS > 0 ? TANGENTS : 1)
#define TANGENT_NUMBERS (TANGENT_VECTORS * MODEL_STATE_COUNT)

// Scales a vector to length 1 and returns the logarithm of its length. The greatest component is
// taken out first, so that no square overflows or vanishes in fp32.
SHARED_FN real tangent_normalize(real* w) {
  const real one = 1;
  real greatest = lane_abs(w[0]);
  for (int i = 1; i < MODEL_STATE_COUNT; ++i) greatest = lane_max(greatest, lane_abs(w[i]));
  const real scale = one / greatest;
  real squares = 0;
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    w[i] = w[i] * scale;
    squares = squares + w[i] * w[i];
  }
  const real length = lane_sqrt(squares);
  const real inverse = one / length;
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) w[i] = w[i] * inverse;
  return lane_log(greatest) + lane_log(length);
}

// Makes the vectors orthonormal, and adds the logarithm of how far each had grown.
SHARED_FN void tangent_orthonormalize(real* w, real* growth) {
  for (int j = 0; j < TANGENTS; ++j) {
    real* row = w + j * MODEL_STATE_COUNT;
    growth[j] = growth[j] + tangent_normalize(row);
    for (int k = j + 1; k < TANGENTS; ++k) {
      real* other = w + k * MODEL_STATE_COUNT;
      real product = 0;
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) product = product + row[i] * other[i];
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) other[i] = other[i] - product * row[i];
    }
  }
}

// Advances a state and its tangent vectors by one step.
SHARED_FN void tangent_step(const ModelPoint* point, TABLE PhaseCoefs* stage, real h, real* x,
                            real* w) {
  ModelLinear linear[RK4_EVALUATIONS];
  rk4_step_linearized(point, stage, h, x, linear);
  // Not unrolled: many vectors do not fit the registers, one does.
  for (int j = 0; j < TANGENTS; ++j) {
    real row[MODEL_STATE_COUNT];
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) row[i] = w[j * MODEL_STATE_COUNT + i];
    rk4_tangent_step(point, stage, h, linear, row);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) w[j * MODEL_STATE_COUNT + i] = row[i];
  }
}
