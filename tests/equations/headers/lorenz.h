// lorenz: the convection model of Lorenz, Journal of the Atmospheric Sciences 20 (1963) 130-141.
// Autonomous: sections are taken at a chosen interval of time.
#define MODEL_NAME "lorenz"
#define MODEL_SUMMARY "Lorenz's convection, autonomous (Lorenz 1963)"

// X(name, unit, meaning)
#define MODEL_STATES(X)                              \
  X(x, "1", "intensity of the convection")           \
  X(y, "1", "temperature difference of the streams") \
  X(z, "1", "departure of the profile from a straight line")

// One direction contracts by 15 to 25 per unit of time: shorter steps than by default.
#define MODEL_MAX_STEP 0.01

// X(name, unit, default, min, max, shapes the phase coefficients, meaning)
#define MODEL_PARAMETERS(X)                                                         \
  X(sigma, "1", 10.0, 0.0, 1e3, 0, "Prandtl number")                                \
  X(rho, "1", 28.0, 0.0, 1e3, 0, "Rayleigh number / that of the onset")             \
  X(beta, "1", 2.66666666666666666667, 0.0, 1e3, 0, "shape of the convection cell") \
  X(period, "1", 1.0, 1e-3, 1e3, 0, "time from section to section")

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X)                                                                   \
  X(classic, "Lorenz's own parameters; published start 0, -0.01, 9 (at 0, 0, 0 it rests)", \
    "policy = 'fixed'")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X) X(energy, "1", "(x^2 + y^2 + z^2)/2")

#include "model_types.h"

typedef struct {
  real period;
  real sigma, rho, beta;
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  (void)options;
  point->period = p->period;
  point->sigma = p->sigma;
  point->rho = p->rho;
  point->beta = p->beta;
}

SHARED_FN void model_rhs(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                         real* dx) {
  (void)phase;
  dx[STATE_x] = point->sigma * (x[STATE_y] - x[STATE_x]);
  dx[STATE_y] = x[STATE_x] * (point->rho - x[STATE_z]) - x[STATE_y];
  dx[STATE_z] = x[STATE_x] * x[STATE_y] - point->beta * x[STATE_z];
}

// `scale` times the Jacobian at a state.
typedef struct {
  real scale;
  real x, y, slope;  // slope: rho - z; not scaled
} ModelLinear;

SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  (void)phase;
  linear->scale = scale;
  linear->x = x[STATE_x];
  linear->y = x[STATE_y];
  linear->slope = point->rho - x[STATE_z];
}

// out = base + scale J w; out is neither w nor base.
SHARED_FN void model_tangent(const ModelPoint* point, const ModelLinear* linear, const real* w,
                             const real* base, real* out) {
  const real scale = linear->scale;
  out[STATE_x] = base[STATE_x] + scale * (point->sigma * (w[STATE_y] - w[STATE_x]));
  out[STATE_y] =
      base[STATE_y] + scale * (linear->slope * w[STATE_x] - w[STATE_y] - linear->x * w[STATE_z]);
  out[STATE_z] = base[STATE_z] + scale * (linear->y * w[STATE_x] + linear->x * w[STATE_y] -
                                          point->beta * w[STATE_z]);
}

SHARED_FN void model_signals(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelSignals* signals) {
  (void)point;
  (void)phase;
  signals->energy =
      (scalar)(0.5) * (x[STATE_x] * x[STATE_x] + x[STATE_y] * x[STATE_y] + x[STATE_z] * x[STATE_z]);
}

#ifdef MODEL_HOST_PART
// Steady convection, where there is any; otherwise rest.
inline void model_equilibrium(const ModelParameters& p, const ModelOptions&, double* x) {
  x[STATE_z] = std::fmax(p.rho - 1.0, 0.0);
  x[STATE_x] = x[STATE_y] = std::sqrt(p.beta * x[STATE_z]);
}
#endif
