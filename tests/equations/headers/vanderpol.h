// vanderpol: x'' - mu (1 - x^2) x' + x = amplitude sin(omega t), van der Pol's relaxation
// oscillator with forcing (van der Pol and van der Mark, Nature 120 (1927) 363-364).
#define MODEL_NAME "vanderpol"
#define MODEL_SUMMARY "forced van der Pol oscillator (van der Pol and van der Mark 1927)"

// X(name, unit, meaning)
#define MODEL_STATES(X) \
  X(x, "1", "position") \
  X(v, "1", "velocity")

// Positions, then their velocities in the same order: tangent vectors cost less.
#define MODEL_SECOND_ORDER

// Where |x| is large the velocity decays by mu (x^2 - 1), some 15 per unit of time: shorter steps
// than by default.
#define MODEL_MAX_STEP 0.02

// X(name, unit, default, min, max, shapes the phase coefficients, meaning)
#define MODEL_PARAMETERS(X)                                        \
  X(mu, "1", 3.0, 0.0, 100.0, 0, "strength of the damping")        \
  X(amplitude, "1", 5.0, -1e4, 1e4, 0, "amplitude of the forcing") \
  X(omega, "1", 1.788, 1e-4, 100.0, 0, "angular frequency of the forcing")

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X) X(sprott, "chaotic; published start -1.9, 0", "policy = 'fixed'")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X) X(energy, "1", "(v^2 + x^2)/2")

// What depends on the phase alone.
#define MODEL_PHASE_COEFS(X) X(sine, "sin(2 pi psi)")

#include "model_types.h"

typedef struct {
  real period;
  real mu, amplitude;
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  (void)options;
  point->period = (scalar)(TWO_PI) / p->omega;
  point->mu = p->mu;
  point->amplitude = p->amplitude;
}

SHARED_FN void model_rhs(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                         real* dx) {
  const real one = 1;
  const real growth = point->mu * (one - x[STATE_x] * x[STATE_x]);
  dx[STATE_x] = x[STATE_v];
  dx[STATE_v] = point->amplitude * phase->sine + growth * x[STATE_v] - x[STATE_x];
}

// `scale` times the Jacobian at a state.
typedef struct {
  real scale;
  real growth;     // mu (1 - x^2)
  real stiffness;  // 1 + 2 mu x v
} ModelLinear;

SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  (void)phase;
  const real one = 1;
  linear->scale = scale;
  linear->growth = scale * point->mu * (one - x[STATE_x] * x[STATE_x]);
  linear->stiffness = scale * (one + (scalar)(2) * point->mu * (x[STATE_x] * x[STATE_v]));
}

// out = base + scale J w; out is neither w nor base.
SHARED_FN void model_tangent(const ModelPoint* point, const ModelLinear* linear, const real* w,
                             const real* base, real* out) {
  (void)point;
  out[STATE_x] = base[STATE_x] + linear->scale * w[STATE_v];
  out[STATE_v] = base[STATE_v] - linear->stiffness * w[STATE_x] + linear->growth * w[STATE_v];
}

SHARED_FN void model_signals(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelSignals* signals) {
  (void)point;
  (void)phase;
  signals->energy = (scalar)(0.5) * (x[STATE_v] * x[STATE_v] + x[STATE_x] * x[STATE_x]);
}

#ifdef MODEL_HOST_PART
inline PhaseCoefs model_phase_coefs(const ModelParameters&, const ModelOptions&, double psi,
                                    double) {
  return {std::sin(TWO_PI * psi)};
}
#endif
