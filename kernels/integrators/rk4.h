// One step of the classical fourth-order Runge-Kutta method on the phase grid. The model's phase
// coefficients come from a table: stage[0] at the step's start, stage[1] in its middle, stage[2] at
// its end; the next step of the same segment starts at stage[2].

#define RK4_STAGES_PER_STEP 2
#define RK4_EVALUATIONS 4

// out = base + h slope.
SHARED_FN void rk4_advance(const real* base, real h, const real* slope, real* out) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) out[i] = base[i] + h * slope[i];
}

// The lengths of a step's parts.
typedef struct {
  real half_h, third_h, sixth_h;
} Rk4Lengths;

SHARED_FN Rk4Lengths rk4_lengths(real h) {
  Rk4Lengths lengths;
  lengths.half_h = (scalar)(0.5) * h;
  lengths.third_h = (scalar)(1.0 / 3.0) * h;
  lengths.sixth_h = (scalar)(1.0 / 6.0) * h;
  return lengths;
}

// Advances x by h (dimensionless time). Unless `linear` is null, it keeps the linearisation at each
// of the RK4_EVALUATIONS, for rk4_tangent_step.
SHARED_FN void rk4_step_linearized(const ModelPoint* point, TABLE PhaseCoefs* stage, real h,
                                   real* x, ModelLinear* linear) {
  const Rk4Lengths lengths = rk4_lengths(h);
  const PhaseCoefs start = stage[0];
  const PhaseCoefs middle = stage[1];
  const PhaseCoefs end = stage[2];
  real slope[MODEL_STATE_COUNT];
  real at[MODEL_STATE_COUNT];
  real next[MODEL_STATE_COUNT];

  if (linear) model_linearize(point, &start, x, &linear[0]);
  model_rhs(point, &start, x, slope);
  rk4_advance(x, lengths.sixth_h, slope, next);
  rk4_advance(x, lengths.half_h, slope, at);
  if (linear) model_linearize(point, &middle, at, &linear[1]);
  model_rhs(point, &middle, at, slope);
  rk4_advance(next, lengths.third_h, slope, next);
  rk4_advance(x, lengths.half_h, slope, at);
  if (linear) model_linearize(point, &middle, at, &linear[2]);
  model_rhs(point, &middle, at, slope);
  rk4_advance(next, lengths.third_h, slope, next);
  rk4_advance(x, h, slope, at);
  if (linear) model_linearize(point, &end, at, &linear[3]);
  model_rhs(point, &end, at, slope);
  rk4_advance(next, lengths.sixth_h, slope, x);
}

// Advances x by h.
SHARED_FN void rk4_step(const ModelPoint* point, TABLE PhaseCoefs* stage, real h, real* x) {
  rk4_step_linearized(point, stage, h, x, 0);
}

// Advances a tangent vector w by the same step: the derivative of the discrete map along w.
SHARED_FN void rk4_tangent_step(const ModelPoint* point, TABLE PhaseCoefs* stage, real h,
                                const ModelLinear* linear, real* w) {
  const Rk4Lengths lengths = rk4_lengths(h);
  const PhaseCoefs start = stage[0];
  const PhaseCoefs middle = stage[1];
  const PhaseCoefs end = stage[2];
  real slope[MODEL_STATE_COUNT];
  real at[MODEL_STATE_COUNT];
  real next[MODEL_STATE_COUNT];

  model_tangent(point, &start, &linear[0], w, slope);
  rk4_advance(w, lengths.sixth_h, slope, next);
  rk4_advance(w, lengths.half_h, slope, at);
  model_tangent(point, &middle, &linear[1], at, slope);
  rk4_advance(next, lengths.third_h, slope, next);
  rk4_advance(w, lengths.half_h, slope, at);
  model_tangent(point, &middle, &linear[2], at, slope);
  rk4_advance(next, lengths.third_h, slope, next);
  rk4_advance(w, h, slope, at);
  model_tangent(point, &end, &linear[3], at, slope);
  rk4_advance(next, lengths.sixth_h, slope, w);
}
