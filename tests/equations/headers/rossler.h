// rossler: the folded band of Roessler, Physics Letters A 57 (1976) 397-398. Autonomous: sections
// are taken at a chosen interval of time.
#define MODEL_NAME "rossler"
#define MODEL_SUMMARY "Roessler's folded band, autonomous (Roessler 1976)"

// X(name, unit, meaning)
#define MODEL_STATES(X)                   \
  X(x, "1", "first of the turning pair")  \
  X(y, "1", "second of the turning pair") \
  X(z, "1", "switch that folds the band")

// While x is small, z decays by c and more: shorter steps than by default.
#define MODEL_MAX_STEP 0.02

// X(name, unit, default, min, max, shapes the phase coefficients, meaning)
#define MODEL_PARAMETERS(X)                                    \
  X(a, "1", 0.2, -10.0, 10.0, 0, "growth of the turning pair") \
  X(b, "1", 0.2, -10.0, 10.0, 0, "constant input of z")        \
  X(c, "1", 5.7, -100.0, 100.0, 0, "x beyond which z grows")   \
  X(period, "1", 1.0, 1e-3, 1e3, 0, "time from section to section")

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X) \
  X(classic, "Roessler's own parameters; published start -9, 0, 0", "policy = 'fixed'")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X) X(radius, "1", "distance of (x, y) from the origin")

#include "model_types.h"

typedef struct {
  real period;
  real a, b, c;
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  (void)options;
  point->period = p->period;
  point->a = p->a;
  point->b = p->b;
  point->c = p->c;
}

SHARED_FN void model_rhs(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                         real* dx) {
  (void)phase;
  dx[STATE_x] = -x[STATE_y] - x[STATE_z];
  dx[STATE_y] = x[STATE_x] + point->a * x[STATE_y];
  dx[STATE_z] = point->b + x[STATE_z] * (x[STATE_x] - point->c);
}

// `scale` times the Jacobian at a state.
typedef struct {
  real scale;
  real z, growth;  // growth: x - c; not scaled
} ModelLinear;

SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  (void)phase;
  linear->scale = scale;
  linear->z = x[STATE_z];
  linear->growth = x[STATE_x] - point->c;
}

// out = base + scale J w; out is neither w nor base.
SHARED_FN void model_tangent(const ModelPoint* point, const ModelLinear* linear, const real* w,
                             const real* base, real* out) {
  const real scale = linear->scale;
  out[STATE_x] = base[STATE_x] - scale * (w[STATE_y] + w[STATE_z]);
  out[STATE_y] = base[STATE_y] + scale * (w[STATE_x] + point->a * w[STATE_y]);
  out[STATE_z] = base[STATE_z] + scale * (linear->z * w[STATE_x] + linear->growth * w[STATE_z]);
}

SHARED_FN void model_signals(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelSignals* signals) {
  (void)point;
  (void)phase;
  signals->radius = lane_sqrt(x[STATE_x] * x[STATE_x] + x[STATE_y] * x[STATE_y]);
}

#ifdef MODEL_HOST_PART
// The equilibrium in the middle of the band, x = a z and y = -z with a z^2 - c z + b = 0; where
// there is none, the vertex of that parabola. The smaller root is written without cancellation.
inline void model_equilibrium(const ModelParameters& p, const ModelOptions&, double* x) {
  const double root = std::sqrt(std::fmax(p.c * p.c - 4.0 * p.a * p.b, 0.0));
  const double divisor = p.c + std::copysign(root, p.c);
  x[STATE_z] = divisor == 0.0 ? 0.0 : 2.0 * p.b / divisor;
  x[STATE_x] = p.a * x[STATE_z];
  x[STATE_y] = -x[STATE_z];
}
#endif
