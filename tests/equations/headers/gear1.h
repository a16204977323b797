// gear1: a gear pair on rigid shafts, one degree of freedom with backlash and time-varying mesh
// stiffness, x'' + 2 z x' + K(t) f(x; b) = Fm + sum_r Fte_r (r omega)^2 cos(r omega t), after
// Kahraman and Singh, Journal of Sound and Vibration 142 (1990) 49-75 and 146 (1991) 135-156.
// Lengths in half backlashes b_n, time in 1/varpi, varpi^2 = mean mesh stiffness k0 / equivalent
// mass, forces in k0 b_n.
#define MODEL_NAME "gear1"
#define MODEL_SUMMARY "gear pair, 1 degree of freedom (Kahraman and Singh 1990)"

// X(name, unit, meaning)
#define MODEL_STATES(X)                                                       \
  X(x, "b_n", "transmission error, dynamic less static: the mesh deflection") \
  X(v, "b_n varpi", "velocity of x")

// Positions, then their velocities in the same order: tangent vectors cost less.
#define MODEL_SECOND_ORDER

#define MODEL_MAX_STEP 0.05

// A force that starts at the limits of a backlash: steps that cross one are corrected.
#define MODEL_CONTACT

// X(name, unit, default, min, max, shapes the phase coefficients, meaning).
// A name followed by _2, _3, ... continues a list that is given under the plain name.
#define MODEL_PARAMETERS(X)                                                             \
  X(omega, "varpi", 0.8, 1e-4, 100.0, 0, "mesh frequency")                              \
  X(b, "b_n", 1.0, 0.0, 1e4, 0, "half backlash")                                        \
  X(z, "1", 0.05, 0.0, 10.0, 0, "damping ratio")                                        \
  X(Fm, "k0 b_n", 0.1, 0.0, 1e3, 0, "mean load")                                        \
  X(Fte, "b_n", 0.01, -1e3, 1e3, 0, "static transmission error, harmonic 1")            \
  X(Fte_2, "b_n", 0.004, -1e3, 1e3, 0, "static transmission error, harmonic 2")         \
  X(Fte_3, "b_n", 0.002, -1e3, 1e3, 0, "static transmission error, harmonic 3")         \
  X(k, "k0", 0.2, -1.0, 1.0, 0, "fall of the stiffness, first harmonic or square wave") \
  X(k_2, "k0", 0.1, -1.0, 1.0, 0, "fall of the stiffness, harmonic 2")                  \
  X(k_3, "k0", 0.05, -1.0, 1.0, 0, "fall of the stiffness, harmonic 3")                 \
  X(share, "1", 0.5, 0.01, 0.99, 1, "square wave: share of the period with stiffness 1 - k")

// X(name, choices with the default first, meaning); the enum below numbers the choices.
#define MODEL_OPTIONS(X) \
  X(stiffness, "harmonic square", "shape of the first term of the stiffness, cos or a square wave")
enum { STIFFNESS_HARMONIC, STIFFNESS_SQUARE };

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X)                                                                 \
  X(spur, "a spur pair, three harmonics of error and stiffness; published start 1.1, 0", \
    "policy = 'fixed'")                                                                  \
  X(coarse, "a large transmission error of one harmonic: chaotic at omega 1.5 and 1.8",  \
    "omega = 1.5\nFte = 0.1\nFte_2 = 0.0\nFte_3 = 0.0\nk_2 = 0.0\nk_3 = 0.0\npolicy = 'fixed'")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X)                    \
  X(deflection, "b_n", "mesh deflection x") \
  X(backlash, "b_n", "half backlash b")     \
  X(dmf, "k0 b_n", "dynamic meshing force K f, no damping")

// What depends on the phase alone.
#define MODEL_PHASE_COEFS(X)   \
  X(cosine, "cos(2 pi psi)")   \
  X(cosine_2, "cos(4 pi psi)") \
  X(cosine_3, "cos(6 pi psi)") \
  X(wave, "what k stands before: cos(2 pi psi), or 1 in the soft part and -1 in the stiff one")

#include "model_types.h"

typedef struct {
  real period;  // of the mesh, 2 pi / omega
  real b;
  real damping;     // 2 z
  real load;        // Fm
  real forcing[3];  // Fte_r (r omega)^2
  real fall[3];     // k_r
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  (void)options;
  const real square = p->omega * p->omega;
  point->period = (scalar)(TWO_PI) / p->omega;
  point->b = p->b;
  point->damping = (scalar)(2) * p->z;
  point->load = p->Fm;
  point->forcing[0] = p->Fte * square;
  point->forcing[1] = (scalar)(4) * p->Fte_2 * square;
  point->forcing[2] = (scalar)(9) * p->Fte_3 * square;
  point->fall[0] = p->k;
  point->fall[1] = p->k_2;
  point->fall[2] = p->k_3;
}

// K of the phase.
SHARED_FN real gear1_stiffness(const ModelPoint* point, const PhaseCoefs* phase) {
  const real one = 1;
  return one - (point->fall[0] * phase->wave + point->fall[1] * phase->cosine_2 +
                point->fall[2] * phase->cosine_3);
}

// f: the part of the deflection beyond the backlash.
SHARED_FN real gear1_penetration(const ModelPoint* point, real deflection) {
  return deflection - lane_clamp(deflection, -point->b, point->b);
}

SHARED_FN void model_contact(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelContact* contact) {
  (void)phase;
  contact->deflection = x[STATE_x];
  contact->backlash = point->b;
}

// model_rhs where the contact is known.
SHARED_FN void model_rhs_in_contact(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                                    const ModelContact* contact, real* dx) {
  const real drive = point->load + point->forcing[0] * phase->cosine +
                     point->forcing[1] * phase->cosine_2 + point->forcing[2] * phase->cosine_3;
  const real force = gear1_stiffness(point, phase) * gear1_penetration(point, contact->deflection);
  dx[STATE_x] = x[STATE_v];
  dx[STATE_v] = drive - point->damping * x[STATE_v] - force;
}

// dx = dx/dtau.
SHARED_FN void model_rhs(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                         real* dx) {
  ModelContact contact;
  model_contact(point, phase, x, &contact);
  model_rhs_in_contact(point, phase, x, &contact, dx);
}

// How dx/dtau changes with the penetration.
SHARED_FN void model_force_direction(const ModelPoint* point, const PhaseCoefs* phase,
                                     const real* x, int contact, real* direction) {
  (void)x;
  (void)contact;
  direction[STATE_x] = 0;
  direction[STATE_v] = -gear1_stiffness(point, phase);
}

// How dx/dtau changes along a direction. That has no position, and so leaves the penetration alone.
SHARED_FN void model_force_direction_carried(const ModelPoint* point, const PhaseCoefs* phase,
                                             const real* x, const real* direction, real* dx) {
  (void)x;
  (void)phase;
  dx[STATE_x] = direction[STATE_v];
  dx[STATE_v] = -point->damping * direction[STATE_v];
}

// `scale` times the Jacobian at a phase and a state.
typedef struct {
  real scale, damping;
  real stiffness;  // 0 in the gap
} ModelLinear;

// The field is continuous at x = +-b, so no jump of the tangent is needed there.
SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  const real zero = 0;
  const real stiffness = scale * gear1_stiffness(point, phase);
  linear->scale = scale;
  linear->damping = scale * point->damping;
  linear->stiffness = lane_select(point->b < lane_abs(x[STATE_x]), stiffness, zero);
}

// What a tangent vector adds to the deflection and to the backlash.
SHARED_FN void model_contact_tangent(const ModelPoint* point, const ModelLinear* linear,
                                     const real* w, ModelContact* added) {
  (void)point;
  (void)linear;
  added->deflection = w[STATE_x];
  added->backlash = 0;
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
  signals->deflection = x[STATE_x];
  signals->backlash = point->b;
  signals->dmf = gear1_stiffness(point, phase) * gear1_penetration(point, x[STATE_x]);
}

#ifdef MODEL_HOST_PART
// The square wave jumps at the end of its soft part.
inline std::vector<double> model_break_phases(const ModelParameters& p,
                                              const ModelOptions& options) {
  if (options.stiffness == STIFFNESS_SQUARE) return {0.0, p.share};
  return {0.0};
}

// `inside` tells which part of the square wave is meant at a jump.
inline PhaseCoefs model_phase_coefs(const ModelParameters& p, const ModelOptions& options,
                                    double psi, double inside) {
  const double turn = TWO_PI * psi;
  PhaseCoefs out = {};
  out.cosine = std::cos(turn);
  out.cosine_2 = std::cos(2.0 * turn);
  out.cosine_3 = std::cos(3.0 * turn);
  out.wave = out.cosine;
  if (options.stiffness == STIFFNESS_SQUARE) out.wave = inside < p.share ? 1.0 : -1.0;
  return out;
}

// Static equilibrium on the drive flank under Fm with stiffness 1.
inline void model_equilibrium(const ModelParameters& p, const ModelOptions&, double* x) {
  x[STATE_x] = p.b + p.Fm;
  x[STATE_v] = 0.0;
}
#endif
