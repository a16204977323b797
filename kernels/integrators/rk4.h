// One step of the classical fourth-order Runge-Kutta method on the phase grid. The model's phase
// coefficients come from a table: stage[0] at the step's start, stage[1] in its middle, stage[2] at
// its end; the next step of the same segment starts at stage[2].

#define RK4_STAGES_PER_STEP 2

// Advances x by h (dimensionless time).
SHARED_FN void rk4_step(const ModelPoint* point, TABLE PhaseCoefs* stage, real h, real* x) {
  const real half_h = (scalar)(0.5) * h;
  const real sixth_h = (scalar)(1.0 / 6.0) * h;
  const real third_h = (scalar)(1.0 / 3.0) * h;
  const PhaseCoefs start = stage[0];
  const PhaseCoefs middle = stage[1];
  const PhaseCoefs end = stage[2];
  real slope[MODEL_STATE_COUNT];
  real at[MODEL_STATE_COUNT];
  real next[MODEL_STATE_COUNT];

  model_rhs(point, &start, x, slope);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    next[i] = x[i] + sixth_h * slope[i];
    at[i] = x[i] + half_h * slope[i];
  }
  model_rhs(point, &middle, at, slope);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    next[i] = next[i] + third_h * slope[i];
    at[i] = x[i] + half_h * slope[i];
  }
  model_rhs(point, &middle, at, slope);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    next[i] = next[i] + third_h * slope[i];
    at[i] = x[i] + h * slope[i];
  }
  model_rhs(point, &end, at, slope);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    x[i] = next[i] + sixth_h * slope[i];
  }
}
