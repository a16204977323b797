// jerk: x''' = -damping x'' - x' + |x| - 1, one of the simplest chaotic flows with a piecewise
// linear term (Linz and Sprott, Physics Letters A 259 (1999) 240-245). Autonomous: sections are
// taken at a chosen interval of time.
#define MODEL_NAME "jerk"
#define MODEL_SUMMARY "piecewise linear jerk flow, autonomous (Linz and Sprott 1999)"

// X(name, unit, meaning)
#define MODEL_STATES(X)      \
  X(x, "1", "position")      \
  X(v, "1", "velocity of x") \
  X(a, "1", "acceleration of x")

// The slope of |x| jumps inside steps, which leaves a lower order: shorter steps than by default.
#define MODEL_MAX_STEP 0.02

// X(name, unit, default, min, max, shapes the phase coefficients, meaning)
#define MODEL_PARAMETERS(X)                                          \
  X(damping, "1", 0.6, -10.0, 10.0, 0, "factor of the acceleration") \
  X(period, "1", 1.0, 1e-3, 1e3, 0, "time from section to section")

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X) X(classic, "damping 0.6; published start 0, -0.7, 0", "policy = 'fixed'")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X) X(jerk, "1", "x'''")

#include "model_types.h"

typedef struct {
  real period;
  real damping;
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  (void)options;
  point->period = p->period;
  point->damping = p->damping;
}

// x''' of a state; `push` stands for |x| - 1.
SHARED_FN real jerk_jerk(const ModelPoint* point, const real* x, real push) {
  return push - x[STATE_v] - point->damping * x[STATE_a];
}

SHARED_FN void model_rhs(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                         real* dx) {
  (void)phase;
  const real one = 1;
  dx[STATE_x] = x[STATE_v];
  dx[STATE_v] = x[STATE_a];
  dx[STATE_a] = jerk_jerk(point, x, lane_abs(x[STATE_x]) - one);
}

// `scale` times the Jacobian at a state.
typedef struct {
  real scale;
  real side;  // the sign of x
} ModelLinear;

// The field is continuous at x = 0, so no jump of the tangent is needed there.
SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  (void)point;
  (void)phase;
  const real zero = 0;
  const real one = 1;
  linear->scale = scale;
  linear->side = lane_select(x[STATE_x] < zero, -one, one);
}

// out = base + scale J w; out is neither w nor base.
SHARED_FN void model_tangent(const ModelPoint* point, const ModelLinear* linear, const real* w,
                             const real* base, real* out) {
  const real scale = linear->scale;
  out[STATE_x] = base[STATE_x] + scale * w[STATE_v];
  out[STATE_v] = base[STATE_v] + scale * w[STATE_a];
  out[STATE_a] = base[STATE_a] + scale * jerk_jerk(point, w, linear->side * w[STATE_x]);
}

SHARED_FN void model_signals(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelSignals* signals) {
  (void)phase;
  const real one = 1;
  signals->jerk = jerk_jerk(point, x, lane_abs(x[STATE_x]) - one);
}

#ifdef MODEL_HOST_PART
// The equilibrium x = -1, which the motion turns about.
inline void model_equilibrium(const ModelParameters&, const ModelOptions&, double* x) {
  x[STATE_x] = -1.0;
  x[STATE_v] = 0.0;
  x[STATE_a] = 0.0;
}
#endif
