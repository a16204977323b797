// duffing: x'' + damping x' + linear x + cubic x^3 = amplitude sin(omega t + phase). A single well
// when `linear` is not negative (Ueda, Journal of Statistical Physics 20 (1979) 181-196), two wells
// when it is (Holmes, Philosophical Transactions of the Royal Society A 292 (1979) 419-448).
#define MODEL_NAME "duffing"
#define MODEL_SUMMARY "Duffing's oscillator, one well or two (Ueda 1979, Holmes 1979)"

// X(name, unit, meaning)
#define MODEL_STATES(X) \
  X(x, "1", "position") \
  X(v, "1", "velocity")

// Positions, then their velocities in the same order: tangent vectors cost less.
#define MODEL_SECOND_ORDER

// Far out the cubic spring makes a quick oscillator: shorter steps than by default.
#define MODEL_MAX_STEP 0.03

// X(name, unit, default, min, max, shapes the phase coefficients, meaning)
#define MODEL_PARAMETERS(X)                                              \
  X(damping, "1", 0.05, -10.0, 100.0, 0, "factor of the velocity")       \
  X(linear, "1", 0.0, -1e3, 1e3, 0, "linear stiffness")                  \
  X(cubic, "1", 1.0, 0.0, 1e3, 0, "cubic stiffness")                     \
  X(amplitude, "1", 7.5, -1e4, 1e4, 0, "amplitude of the forcing")       \
  X(omega, "1", 1.0, 1e-4, 100.0, 0, "angular frequency of the forcing") \
  X(phase, "rad", 0.0, -100.0, 100.0, 1, "phase of the forcing (pi/2: a cosine)")

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X)                                                                   \
  X(ueda, "one well without linear stiffness; published start 2.5, 0", "policy = 'fixed'") \
  X(two_well, "two wells; published start 0.2, 0",                                         \
    "damping = 0.25\nlinear = -1.0\namplitude = 0.4\npolicy = 'fixed'")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X) X(energy, "1", "v^2/2 + linear x^2/2 + cubic x^4/4")

// What depends on the phase alone.
#define MODEL_PHASE_COEFS(X) X(sine, "sin(2 pi psi + phase)")

#include "model_types.h"

typedef struct {
  real period;
  real damping, linear, cubic, amplitude;
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  (void)options;
  point->period = (scalar)(TWO_PI) / p->omega;
  point->damping = p->damping;
  point->linear = p->linear;
  point->cubic = p->cubic;
  point->amplitude = p->amplitude;
}

SHARED_FN void model_rhs(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                         real* dx) {
  const real stiffness = point->linear + point->cubic * (x[STATE_x] * x[STATE_x]);
  dx[STATE_x] = x[STATE_v];
  dx[STATE_v] =
      point->amplitude * phase->sine - point->damping * x[STATE_v] - stiffness * x[STATE_x];
}

// `scale` times the Jacobian at a state.
typedef struct {
  real scale, damping;
  real stiffness;  // linear + 3 cubic x^2
} ModelLinear;

SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  (void)phase;
  linear->scale = scale;
  linear->damping = scale * point->damping;
  linear->stiffness =
      scale * (point->linear + (scalar)(3) * point->cubic * (x[STATE_x] * x[STATE_x]));
}

// out = base + scale J w; out is neither w nor base.
SHARED_FN void model_tangent(const ModelPoint* point, const ModelLinear* linear, const real* w,
                             const real* base, real* out) {
  (void)point;
  out[STATE_x] = base[STATE_x] + linear->scale * w[STATE_v];
  out[STATE_v] = base[STATE_v] - linear->stiffness * w[STATE_x] - linear->damping * w[STATE_v];
}

SHARED_FN void model_signals(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelSignals* signals) {
  (void)phase;
  const real square = x[STATE_x] * x[STATE_x];
  const real spring = point->linear + (scalar)(0.5) * point->cubic * square;
  signals->energy = (scalar)(0.5) * (x[STATE_v] * x[STATE_v] + spring * square);
}

#ifdef MODEL_HOST_PART
inline PhaseCoefs model_phase_coefs(const ModelParameters& p, const ModelOptions&, double psi,
                                    double) {
  return {std::sin(TWO_PI * psi + p.phase)};
}

// Rest without forcing: the bottom of the right well, where there are two.
inline void model_equilibrium(const ModelParameters& p, const ModelOptions&, double* x) {
  x[STATE_x] = p.linear < 0.0 && p.cubic > 0.0 ? std::sqrt(-p.linear / p.cubic) : 0.0;
  x[STATE_v] = 0.0;
}
#endif
