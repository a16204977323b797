// pendulum: x'' + damping x' + sin x = drive sin(omega t + phase), the forced damped pendulum
// (Baker and Gollub, Chaotic Dynamics, 1990; damping = 1/Q there). Full turns are taken out of the
// angle at the end of each period, so rotating motion has sections that stay.
#define MODEL_NAME "pendulum"
#define MODEL_SUMMARY "forced damped pendulum (Baker and Gollub 1990)"

// X(name, unit, meaning)
#define MODEL_STATES(X)                                             \
  X(x, "rad", "angle from the vertical, from -pi to pi at phase 0") \
  X(v, "1", "angular velocity / small-swing angular frequency")

// States that mean the same after a full turn.
#define MODEL_ANGLES(X) X(x)

// Positions, then their velocities in the same order: tangent vectors cost less.
#define MODEL_SECOND_ORDER

#define MODEL_MAX_STEP 0.05

// X(name, unit, default, min, max, shapes the phase coefficients, meaning)
#define MODEL_PARAMETERS(X)                                              \
  X(damping, "1", 0.05, -10.0, 100.0, 0, "factor of the velocity, 1/Q")  \
  X(drive, "1", 0.6, -1e3, 1e3, 0, "amplitude of the forcing torque")    \
  X(omega, "1", 0.7, 1e-4, 100.0, 0, "angular frequency of the forcing") \
  X(phase, "rad", 0.0, -100.0, 100.0, 1, "phase of the forcing (pi/2: a cosine)")

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X)                                                                     \
  X(sprott, "weakly damped, chaotic; published start 0, 0", "policy = 'fixed'")              \
  X(cascade, "drive 1.5 at omega 2/3: period doubling as damping falls from 0.75 to 0.72",   \
    "damping = 0.74\ndrive = 1.5\nomega = 0.66666666666666667\nphase = 1.5707963267948966\n" \
    "policy = 'fixed'")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X) X(energy, "1", "v^2/2 + 1 - cos x")

// What depends on the phase alone.
#define MODEL_PHASE_COEFS(X) X(sine, "sin(2 pi psi + phase)")

#include "model_types.h"

typedef struct {
  real period;
  real damping, drive;
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  (void)options;
  point->period = (scalar)(TWO_PI) / p->omega;
  point->damping = p->damping;
  point->drive = p->drive;
}

SHARED_FN void model_rhs(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                         real* dx) {
  dx[STATE_x] = x[STATE_v];
  dx[STATE_v] = point->drive * phase->sine - point->damping * x[STATE_v] - lane_sin(x[STATE_x]);
}

// `scale` times the Jacobian at a state.
typedef struct {
  real scale, damping;
  real stiffness;  // the cosine of the angle
} ModelLinear;

SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  (void)phase;
  linear->scale = scale;
  linear->damping = scale * point->damping;
  linear->stiffness = scale * lane_cos(x[STATE_x]);
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
  (void)point;
  (void)phase;
  const real one = 1;
  signals->energy = (scalar)(0.5) * x[STATE_v] * x[STATE_v] + (one - lane_cos(x[STATE_x]));
}

#ifdef MODEL_HOST_PART
inline PhaseCoefs model_phase_coefs(const ModelParameters& p, const ModelOptions&, double psi,
                                    double) {
  return {std::sin(TWO_PI * psi + p.phase)};
}
#endif
