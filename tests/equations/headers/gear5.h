// gear5: a geared rotor-bearing pair with five degrees of freedom, backlash that may change as the
// shafts move, sliding friction and time-varying mesh stiffness, after Chen, Tang, Luo, Wang,
// Mechanism and Machine Theory 46 (2011) 466-478 ("the paper"; its equation numbers are used here).
// Lengths in half backlashes b_n, time tau = varpi t with varpi^2 = k0/me, forces in k0 b_n.
#define MODEL_NAME "gear5"
#define MODEL_MAX_STEP 0.05
#define MODEL_SUMMARY "geared rotor-bearing pair, 5 degrees of freedom (Chen et al. 2011)"

// X(name, unit, meaning)
#define MODEL_STATES(X)                                                        \
  X(x1, "b_n", "torsional mesh displacement R_p theta_p - R_g theta_g - e(t)") \
  X(x2, "b_n", "pinion shaft, across the line of action")                      \
  X(x3, "b_n", "pinion shaft, along the line of action")                       \
  X(x4, "b_n", "gear shaft, across the line of action")                        \
  X(x5, "b_n", "gear shaft, along the line of action")                         \
  X(v1, "b_n varpi", "velocity of x1")                                         \
  X(v2, "b_n varpi", "velocity of x2")                                         \
  X(v3, "b_n varpi", "velocity of x3")                                         \
  X(v4, "b_n varpi", "velocity of x4")                                         \
  X(v5, "b_n varpi", "velocity of x5")

// Positions, then their velocities in the same order: tangent vectors cost less.
#define MODEL_SECOND_ORDER

// A force that starts at the limits of a backlash: steps that cross one are corrected.
#define MODEL_CONTACT

// In half backlashes, and those per unit of time.
#define MODEL_DIVERGED_ABOVE 1e6

// X(name, unit, default, min, max, shapes the phase coefficients, meaning).
// A name followed by _2, _3, ... continues a list that is given under the plain name.
#define MODEL_PARAMETERS(X)                                                                       \
  X(omega, "varpi", 0.7, 1e-4, 100.0, 0, "mesh frequency")                                        \
  X(b, "b_n", 1.0, 0.0, 1e4, 0, "half backlash")                                                  \
  X(mu, "1", 0.05, 0.0, 1.0, 0, "friction coefficient of the teeth")                              \
  X(F1, "k0 b_n", 0.1, 0.0, 1e3, 0, "mean load")                                                  \
  X(e0, "b_n", 0.2, 0.0, 1e3, 0, "amplitude of the transmission error")                           \
  X(zeta, "1", 0.04008, 0.0, 10.0, 0, "mesh damping ratio cm/(2 varpi me)")                       \
  X(m1, "1", 0.3507525, 0.0, 100.0, 0, "me/mp, mp the pinion's mass")                             \
  X(m2, "1", 0.3507525, 0.0, 100.0, 0, "me/mg, mg the gear's mass")                               \
  X(k1, "k0", 1.38, 1e-6, 1e6, 0, "bearing stiffness, pinion x")                                  \
  X(k2, "k0", 1.38, 1e-6, 1e6, 0, "bearing stiffness, pinion y")                                  \
  X(k3, "k0", 1.38, 1e-6, 1e6, 0, "bearing stiffness, gear x")                                    \
  X(k4, "k0", 1.38, 1e-6, 1e6, 0, "bearing stiffness, gear y")                                    \
  X(c1, "cm", 2.0, 0.0, 1e4, 0, "bearing damping, pinion x")                                      \
  X(c2, "cm", 2.0, 0.0, 1e4, 0, "bearing damping, pinion y")                                      \
  X(c3, "cm", 2.0, 0.0, 1e4, 0, "bearing damping, gear x")                                        \
  X(c4, "cm", 2.0, 0.0, 1e4, 0, "bearing damping, gear y")                                        \
  X(eps, "1", 1.718, 1.001, 1.999, 1, "contact ratio")                                            \
  X(approach, "1", 0.5, 0.01, 0.99, 1, "share of the contact ratio before the pitch point")       \
  X(alpha, "degree", 20.0, 1.0, 45.0, 1, "pressure angle")                                        \
  X(A, "b_n", 2400.0, 10.0, 1e9, 0, "centre distance")                                            \
  X(rho_p, "1", 0.5, 0.0, 1.0, 1, "pinion's share of the torsional mobility, me/(Ip/Rp^2)")       \
  X(rho_g, "1", 0.5, 0.0, 1.0, 1, "gear's share of the torsional mobility, me/(Ig/Rg^2)")         \
  X(zp, "1", 40.0, 3.0, 1000.0, 1, "teeth of the pinion")                                         \
  X(teeth_ratio, "1", 1.0, 0.01, 100.0, 1, "teeth of the gear / teeth of the pinion")             \
  X(q, "1", 0.35, 0.0, 1.0, 1, "fall of the parabolic pair stiffness towards its ends")           \
  X(engagement, "1", 0.0, 0.0, 0.5, 1,                                                            \
    "share of a base pitch over which a pair of spur teeth takes up its load, and gives it back") \
  X(kappa, "1", 0.03518, -1.0, 1.0, 1, "fourier stiffness, amplitude of harmonic 1")              \
  X(kappa_2, "1", 0.0, -1.0, 1.0, 1, "fourier stiffness, amplitude of harmonic 2")                \
  X(kappa_3, "1", 0.0, -1.0, 1.0, 1, "fourier stiffness, amplitude of harmonic 3")                \
  X(kappa_4, "1", 0.0, -1.0, 1.0, 1, "fourier stiffness, amplitude of harmonic 4")                \
  X(phase, "rad", 5.714, -100.0, 100.0, 1, "fourier stiffness, phase of harmonic 1")              \
  X(phase_2, "rad", 0.0, -100.0, 100.0, 1, "fourier stiffness, phase of harmonic 2")              \
  X(phase_3, "rad", 0.0, -100.0, 100.0, 1, "fourier stiffness, phase of harmonic 3")              \
  X(phase_4, "rad", 0.0, -100.0, 100.0, 1, "fourier stiffness, phase of harmonic 4")              \
  X(e0_2, "b_n", 0.0, 0.0, 1e3, 1, "error series, amplitude of harmonic 2")                       \
  X(e0_3, "b_n", 0.0, 0.0, 1e3, 1, "error series, amplitude of harmonic 3")                       \
  X(e0_4, "b_n", 0.0, 0.0, 1e3, 1, "error series, amplitude of harmonic 4")                       \
  X(e0_5, "b_n", 0.0, 0.0, 1e3, 1, "error series, amplitude of harmonic 5")                       \
  X(e0_6, "b_n", 0.0, 0.0, 1e3, 1, "error series, amplitude of harmonic 6")                       \
  X(e0_7, "b_n", 0.0, 0.0, 1e3, 1, "error series, amplitude of harmonic 7")                       \
  X(e0_8, "b_n", 0.0, 0.0, 1e3, 1, "error series, amplitude of harmonic 8")                       \
  X(e0_phase, "rad", 0.0, -100.0, 100.0, 1, "phase of the transmission error, of its harmonic 1") \
  X(e0_phase_2, "rad", 0.0, -100.0, 100.0, 1, "error series, phase of harmonic 2")                \
  X(e0_phase_3, "rad", 0.0, -100.0, 100.0, 1, "error series, phase of harmonic 3")                \
  X(e0_phase_4, "rad", 0.0, -100.0, 100.0, 1, "error series, phase of harmonic 4")                \
  X(e0_phase_5, "rad", 0.0, -100.0, 100.0, 1, "error series, phase of harmonic 5")                \
  X(e0_phase_6, "rad", 0.0, -100.0, 100.0, 1, "error series, phase of harmonic 6")                \
  X(e0_phase_7, "rad", 0.0, -100.0, 100.0, 1, "error series, phase of harmonic 7")                \
  X(e0_phase_8, "rad", 0.0, -100.0, 100.0, 1, "error series, phase of harmonic 8")                \
  X(cycle, "1", 1.0, 1.0, 1e6, 1, "mesh periods in one period of the forcing")                    \
  X(runout_p, "b_n", 0.0, 0.0, 1e3, 1,                                                            \
    "error series, runout of the pinion: amplitude once per turn")                                \
  X(runout_g, "b_n", 0.0, 0.0, 1e3, 1,                                                            \
    "error series, runout of the gear: amplitude once per turn")                                  \
  X(runout_phase_p, "rad", 0.0, -100.0, 100.0, 1, "phase of the pinion's runout")                 \
  X(runout_phase_g, "rad", 0.0, -100.0, 100.0, 1, "phase of the gear's runout")                   \
  X(damage_p, "1", 0.0, 0.0, 1.0, 1,                                                              \
    "share of its pair's stiffness that the pinion's tooth 0 loses")                              \
  X(damage_g, "1", 0.0, 0.0, 1.0, 1,                                                              \
    "share of its pair's stiffness that the gear's tooth 0 loses")                                \
  X(overlap, "1", 0.0, 0.0, 10.0, 1, "overlap ratio of helical teeth")

// X(name, choices with the default first, meaning); the enums below number the choices.
#define MODEL_OPTIONS(X)                                                             \
  X(formulation, "consistent printed", "sign of the shafts in the mesh deflection")  \
  X(backlash, "constant dynamic",                                                    \
    "whether the backlash follows the shafts (Chen et al. 2011, Eq. 20)")            \
  X(stiffness, "parabolic rectangular fourier table", "shape of the pair stiffness") \
  X(error, "sine series", "transmission error: one sine, or more than that")
enum { FORMULATION_CONSISTENT, FORMULATION_PRINTED };
enum { BACKLASH_CONSTANT, BACKLASH_DYNAMIC };
enum { STIFFNESS_PARABOLIC, STIFFNESS_RECTANGULAR, STIFFNESS_FOURIER, STIFFNESS_TABLE };
enum { ERROR_SINE, ERROR_SERIES };

// X(name, meaning): what may be measured.
#define MODEL_CURVES(X)                                                                       \
  X(measured_stiffness, "of stiffness table, over a mesh period: the mesh stiffness in k0")   \
  X(load_share, "of stiffness table: the share of the pair that entered last")                \
  X(pitch_p, "of error series, over a turn of the pinion: pitch errors in b_n")               \
  X(pitch_g, "over a turn of the gear")                                                       \
  X(pitch_bend_p, "minus the second derivative of pitch_p by the angle of the turn")          \
  X(pitch_bend_g, "of pitch_g")                                                               \
  X(damage_curve_p, "what the pinion's tooth 0 loses, over half a turn: the path of contact") \
  X(damage_curve_g, "what the gear's tooth 0 loses")                                          \
  X(torque_swing, "over a turn of the pinion: what its torque adds to the mean load, in k0 b_n")

// X(name, meaning, TOML of what differs from the defaults above)
#define MODEL_PRESETS(X)                                                                      \
  X(consistent, "a steel pair, 40/40 teeth, module 3 mm, stiff bearings: the one to use", "") \
  X(coarse, "the same pair with a larger transmission error: rich dynamics", "e0 = 0.6")      \
  X(paper, "a fit to the figures of Chen et al. 2011: the one to reproduce",                  \
    "omega = 0.5\nF1 = 0.173386\ne0 = 0.120023\nzeta = 0.00250676\n"                          \
    "m1 = 0.0387\nm2 = 0.0387\nk1 = 1.47042\nk2 = 1.47042\nk3 = 1.47042\nk4 = 1.47042\n"      \
    "formulation = 'printed'\nstiffness = 'fourier'\npolicy = 'fixed'\n")

// X(name, unit, meaning)
#define MODEL_SIGNALS(X)                                                                 \
  X(deflection, "b_n", "mesh deflection D along the line of action")                     \
  X(backlash, "b_n", "half backlash b' at work")                                         \
  X(dmf, "k0 b_n", "dynamic meshing force (Chen et al. 2011, Eq. 22)")                   \
  X(mesh_stiffness, "k0", "stiffness of all tooth pairs at work, B")                     \
  X(friction, "k0 b_n", "sliding friction on the shafts, C f + 2 zeta H D', all pairs")  \
  X(friction_lever, "k0 b_n", "what friction takes from the force on x1, all pairs")     \
  X(dte, "b_n", "dynamic transmission error R_p theta_p - R_g theta_g = x1 + e(t)")      \
  X(bearing_p, "k0 b_n", "force on the pinion's bearing, of its spring and damper")      \
  X(bearing_g, "k0 b_n", "force on the gear's bearing, of its spring and damper")        \
  X(power_damping, "k0 b_n^2 varpi", "power that the dampers of mesh and bearings take") \
  X(power_friction, "k0 b_n^2 varpi", "power that friction takes from the vibration")

// What depends on the phase alone. With friction arms a_i = rho_p s_pi/Rp + rho_g s_gi/Rg (printed:
// s_gi/R) and sliding directions lambda_i, the sums of model equations over the pairs are
//   Q = stiffness - mu lever, G = 2 - mu lever_damping, C = mu slide, H = mu slide_damping.
#define MODEL_PHASE_COEFS(X)                                            \
  X(stiffness, "B = kappa_1 + kappa_2")                                 \
  X(lever, "sum of lambda_i a_i kappa_i")                               \
  X(lever_damping, "sum of lambda_i a_i")                               \
  X(slide, "sum of lambda_i kappa_i (printed: with the opposite sign)") \
  X(slide_damping, "sum of lambda_i (printed: with the opposite sign)") \
  X(sine, "sin(2 pi psi + e0_phase), psi the phase of the mesh")        \
  X(excitation, "of all other errors e in b_n: -d^2 e/d(omega tau)^2")  \
  X(error, "all other errors e in b_n")                                 \
  X(torque, "what the torque of the pinion adds to the mean load")      \
  X(cos_alpha, "cos(alpha), the same at all phases")                    \
  X(sin_alpha, "sin(alpha), the same at all phases")                    \
  X(tan_alpha, "tan(alpha), the same at all phases")

#include "model_types.h"

#ifdef MODEL_HOST_PART
#define MODEL_CURVE_FIELD(name, meaning) Curve name;
struct ModelCurves {
  MODEL_CURVES(MODEL_CURVE_FIELD)
};
#endif

// What a point needs in the inner loop.
typedef struct {
  real period;           // of the forcing, cycle 2 pi / omega
  real load;             // F1
  real error;            // e0
  real forcing;          // e0 omega^2
  real series_forcing;   // omega^2
  real friction;         // mu
  real normal_damping;   // 4 zeta
  real sliding_damping;  // 2 zeta mu
  real b;
  real per_centre;            // 1 / A
  real per_half_centre;       // 2 / A
  real per_two_centres;       // 1 / (2 A)
  real mass_p, mass_g;        // m1, m2
  real bearing_damping[4];    // 2 m c zeta of x2..x5
  real bearing_stiffness[4];  // m k of x2..x5
  real bearing_springs[4];    // k of x2..x5
  real bearing_dampers[4];    // 2 c zeta of x2..x5
  int printed, dynamic, series;
} ModelPoint;

SHARED_FN void model_prepare(const ModelParameters* p, ModelOptions options, ModelPoint* point) {
  point->period = p->cycle * ((scalar)(TWO_PI) / p->omega);
  point->load = p->F1;
  point->error = p->e0;
  point->forcing = p->e0 * p->omega * p->omega;
  point->series_forcing = p->omega * p->omega;
  point->friction = p->mu;
  const real damping = (scalar)(2) * p->zeta;
  point->normal_damping = (scalar)(2) * damping;
  point->sliding_damping = damping * p->mu;
  point->b = p->b;
  point->per_centre = (scalar)(1) / p->A;
  point->per_half_centre = (scalar)(2) * point->per_centre;
  point->per_two_centres = (scalar)(0.5) * point->per_centre;
  point->mass_p = p->m1;
  point->mass_g = p->m2;
  point->bearing_damping[0] = damping * p->m1 * p->c1;
  point->bearing_damping[1] = damping * p->m1 * p->c2;
  point->bearing_damping[2] = damping * p->m2 * p->c3;
  point->bearing_damping[3] = damping * p->m2 * p->c4;
  point->bearing_stiffness[0] = p->m1 * p->k1;
  point->bearing_stiffness[1] = p->m1 * p->k2;
  point->bearing_stiffness[2] = p->m2 * p->k3;
  point->bearing_stiffness[3] = p->m2 * p->k4;
  point->bearing_springs[0] = p->k1;
  point->bearing_springs[1] = p->k2;
  point->bearing_springs[2] = p->k3;
  point->bearing_springs[3] = p->k4;
  point->bearing_dampers[0] = damping * p->c1;
  point->bearing_dampers[1] = damping * p->c2;
  point->bearing_dampers[2] = damping * p->c3;
  point->bearing_dampers[3] = damping * p->c4;
  point->printed = options.formulation == FORMULATION_PRINTED;
  point->dynamic = options.backlash == BACKLASH_DYNAMIC;
  point->series = options.error == ERROR_SERIES;
}

// D from positions (or D' from velocities) of x1, x3, x5.
SHARED_FN real gear5_deflection(const ModelPoint* point, real s1, real s3, real s5) {
  if (point->printed) return s1 + s3 - s5;
  return s1 - s3 + s5;
}

// b' of Eq. (20) = b + (S - A) tan(alpha). With u = x4 - x2 and v = x3 - x5, S^2 = A^2 + 2 A y, so
// that (S - A)/y = 2/(1 + S/A) has no difference of nearly equal lengths.
SHARED_FN real gear5_backlash(const ModelPoint* point, const PhaseCoefs* phase, const real* x) {
  if (!point->dynamic) return point->b;
  const real u = x[STATE_x4] - x[STATE_x2];
  const real v = x[STATE_x3] - x[STATE_x5];
  const real y = u * (phase->cos_alpha + u * point->per_two_centres) +
                 v * (phase->sin_alpha + v * point->per_two_centres);
  return point->b + (y * phase->tan_alpha) * root_ratio(y * point->per_half_centre);
}

// f, the part of the deflection beyond each flank's limit: max(D - b', 0) + min(D + b', 0). That is
// Eq. (19) while b' >= 0. A tooth whose working backlash is negative is wedged: both flanks touch
// at once while |D| < -b'. A constant backlash is never negative, and so a clamp does, which is
// less work.
SHARED_FN real gear5_penetration(const ModelPoint* point, const ModelContact* contact) {
  const real zero = 0;
  const real deflection = contact->deflection;
  const real backlash = contact->backlash;
  if (!point->dynamic) return deflection - lane_clamp(deflection, -backlash, backlash);
  return lane_max(deflection - backlash, zero) + lane_min(deflection + backlash, zero);
}

// How the mesh acts on the shafts: Q, 2 zeta G, B, mu C and 2 zeta mu H of the model equations.
typedef struct {
  real stiffness, damping;  // on x1
  real normal_stiffness;    // along the line of action; its damping is 4 zeta
  real slide_stiffness, slide_damping;
} Gear5Mesh;

// None of it waits for the state, and so the chain from one stage's velocities to the next stage's
// is short.
SHARED_FN Gear5Mesh gear5_mesh(const ModelPoint* point, const PhaseCoefs* phase) {
  Gear5Mesh mesh;
  mesh.stiffness = phase->stiffness - point->friction * phase->lever;
  mesh.damping = point->normal_damping - point->sliding_damping * phase->lever_damping;
  mesh.normal_stiffness = phase->stiffness;
  mesh.slide_stiffness = point->friction * phase->slide;
  mesh.slide_damping = point->sliding_damping * phase->slide_damping;
  return mesh;
}

// What drives x1: the mean load and the errors of the mesh.
SHARED_FN real gear5_drive(const ModelPoint* point, const PhaseCoefs* phase) {
  const real drive = point->load + phase->torque + point->forcing * phase->sine;
  if (!point->series) return drive;
  return drive + point->series_forcing * phase->excitation;
}

// The equations of motion, linear in all but f: dx from x, the penetration f, the deflection's rate
// and what drives x1. Fused, a sum of two products works out the second one first, so what waits
// longest for the velocities, the rate and the forces that it gives, is the first.
SHARED_FN void gear5_motion(const ModelPoint* point, const Gear5Mesh* mesh, const real* x, real f,
                            real rate, real drive, real* dx) {
  const real normal = point->normal_damping * rate + mesh->normal_stiffness * f;
  const real sliding = mesh->slide_damping * rate + mesh->slide_stiffness * f;

  dx[STATE_x1] = x[STATE_v1];
  dx[STATE_x2] = x[STATE_v2];
  dx[STATE_x3] = x[STATE_v3];
  dx[STATE_x4] = x[STATE_v4];
  dx[STATE_x5] = x[STATE_v5];
  dx[STATE_v1] = drive - mesh->stiffness * f - mesh->damping * rate;
  dx[STATE_v2] = -(point->mass_p * sliding + (point->bearing_damping[0] * x[STATE_v2] +
                                              point->bearing_stiffness[0] * x[STATE_x2]));
  dx[STATE_v3] = point->mass_p * normal - (point->bearing_damping[1] * x[STATE_v3] +
                                           point->bearing_stiffness[1] * x[STATE_x3]);
  dx[STATE_v4] = point->mass_g * sliding - (point->bearing_damping[2] * x[STATE_v4] +
                                            point->bearing_stiffness[2] * x[STATE_x4]);
  dx[STATE_v5] = -(point->mass_g * normal + (point->bearing_damping[3] * x[STATE_v5] +
                                             point->bearing_stiffness[3] * x[STATE_x5]));
}

SHARED_FN void model_contact(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelContact* contact) {
  contact->deflection = gear5_deflection(point, x[STATE_x1], x[STATE_x3], x[STATE_x5]);
  contact->backlash = gear5_backlash(point, phase, x);
}

// model_rhs where the contact is known.
SHARED_FN void model_rhs_in_contact(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                                    const ModelContact* contact, real* dx) {
  const real rate = gear5_deflection(point, x[STATE_v1], x[STATE_v3], x[STATE_v5]);
  const real f = gear5_penetration(point, contact);
  const Gear5Mesh mesh = gear5_mesh(point, phase);
  gear5_motion(point, &mesh, x, f, rate, gear5_drive(point, phase), dx);
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
  const Gear5Mesh mesh = gear5_mesh(point, phase);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) direction[i] = 0;
  direction[STATE_v1] = -mesh.stiffness;
  direction[STATE_v2] = -point->mass_p * mesh.slide_stiffness;
  direction[STATE_v3] = point->mass_p * mesh.normal_stiffness;
  direction[STATE_v4] = point->mass_g * mesh.slide_stiffness;
  direction[STATE_v5] = -point->mass_g * mesh.normal_stiffness;
}

// How dx/dtau changes along a direction. That has no positions, and so leaves the penetration
// alone.
SHARED_FN void model_force_direction_carried(const ModelPoint* point, const PhaseCoefs* phase,
                                             const real* x, const real* direction, real* dx) {
  (void)x;
  const real zero = 0;
  const real rate =
      gear5_deflection(point, direction[STATE_v1], direction[STATE_v3], direction[STATE_v5]);
  const Gear5Mesh mesh = gear5_mesh(point, phase);
  gear5_motion(point, &mesh, direction, zero, rate, zero, dx);
}

// `scale` times the Jacobian at a phase and a state, worked out once for all tangent vectors. The
// scale goes with x1's stiffness and damping and with the masses and bearings of the shafts, not
// with the mesh's forces on them. All stiffness of the mesh is 0 in the gap, twice its own where
// the tooth is wedged.
typedef struct {
  real scale;
  real stiffness, damping;                                // of the mesh on x1, scaled
  real normal_stiffness, slide_stiffness, slide_damping;  // of the mesh on the shafts
  real mass_p, mass_g;                                    // scaled from here on
  real bearing_damping[4];
  real bearing_stiffness[4];
  real flank;             // df = dD - flank db' times the flanks that touch; two cancel out
  real wedge_u, wedge_v;  // dynamic backlash: db' = wedge_u d(x4 - x2) + wedge_v d(x3 - x5)
} ModelLinear;

// The field is continuous at D = +-b', so no jump of the tangent is needed there.
SHARED_FN void model_linearize(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                               real scale, ModelLinear* linear) {
  const real zero = 0;
  const real one = 1;
  ModelContact contact;
  model_contact(point, phase, x, &contact);
  const real drive = lane_select(contact.backlash < contact.deflection, one, zero);
  const real back = lane_select(contact.deflection < -contact.backlash, one, zero);
  const real flanks = drive + back;
  const Gear5Mesh mesh = gear5_mesh(point, phase);
  linear->scale = scale;
  linear->stiffness = flanks * (scale * mesh.stiffness);
  linear->damping = scale * mesh.damping;
  linear->normal_stiffness = flanks * mesh.normal_stiffness;
  linear->slide_stiffness = flanks * mesh.slide_stiffness;
  linear->slide_damping = mesh.slide_damping;
  linear->mass_p = scale * point->mass_p;
  linear->mass_g = scale * point->mass_g;
  UNROLL
  for (int i = 0; i < 4; ++i) {
    linear->bearing_damping[i] = scale * point->bearing_damping[i];
    linear->bearing_stiffness[i] = scale * point->bearing_stiffness[i];
  }
  linear->flank = drive - back;
  linear->wedge_u = zero;
  linear->wedge_v = zero;
  if (!point->dynamic) return;
  // dS/du = (u + A cos(alpha))/S, both divided by A; likewise v.
  const real u = phase->cos_alpha + (x[STATE_x4] - x[STATE_x2]) * point->per_centre;
  const real v = phase->sin_alpha + (x[STATE_x3] - x[STATE_x5]) * point->per_centre;
  const real slope = phase->tan_alpha / lane_sqrt(u * u + v * v);
  linear->wedge_u = slope * u;
  linear->wedge_v = slope * v;
}

// What a tangent vector adds to the deflection and to the backlash.
SHARED_FN void model_contact_tangent(const ModelPoint* point, const ModelLinear* linear,
                                     const real* w, ModelContact* added) {
  added->deflection = gear5_deflection(point, w[STATE_x1], w[STATE_x3], w[STATE_x5]);
  added->backlash = 0;
  if (!point->dynamic) return;
  added->backlash =
      linear->wedge_u * (w[STATE_x4] - w[STATE_x2]) + linear->wedge_v * (w[STATE_x3] - w[STATE_x5]);
}

// What it adds to the penetration of one flank that touches; those that touch are in the stiffness.
SHARED_FN real gear5_penetration_tangent(const ModelPoint* point, const ModelLinear* linear,
                                         const real* w) {
  ModelContact added;
  model_contact_tangent(point, linear, w, &added);
  if (!point->dynamic) return added.deflection;
  return added.deflection - linear->flank * added.backlash;
}

// out = base + scale J w; out is neither w nor base. Each sum ends with what waits longest for w's
// rates.
SHARED_FN void model_tangent(const ModelPoint* point, const ModelLinear* linear, const real* w,
                             const real* base, real* out) {
  const real* damping = linear->bearing_damping;
  const real* stiffness = linear->bearing_stiffness;
  const real rate = gear5_deflection(point, w[STATE_v1], w[STATE_v3], w[STATE_v5]);
  const real f = gear5_penetration_tangent(point, linear, w);
  const real normal = point->normal_damping * rate + linear->normal_stiffness * f;
  const real sliding = linear->slide_damping * rate + linear->slide_stiffness * f;

  out[STATE_x1] = base[STATE_x1] + linear->scale * w[STATE_v1];
  out[STATE_x2] = base[STATE_x2] + linear->scale * w[STATE_v2];
  out[STATE_x3] = base[STATE_x3] + linear->scale * w[STATE_v3];
  out[STATE_x4] = base[STATE_x4] + linear->scale * w[STATE_v4];
  out[STATE_x5] = base[STATE_x5] + linear->scale * w[STATE_v5];
  out[STATE_v1] = base[STATE_v1] - linear->stiffness * f - linear->damping * rate;
  out[STATE_v2] = base[STATE_v2] - stiffness[0] * w[STATE_x2] - damping[0] * w[STATE_v2] -
                  linear->mass_p * sliding;
  out[STATE_v3] = base[STATE_v3] - stiffness[1] * w[STATE_x3] - damping[1] * w[STATE_v3] +
                  linear->mass_p * normal;
  out[STATE_v4] = base[STATE_v4] - stiffness[2] * w[STATE_x4] - damping[2] * w[STATE_v4] +
                  linear->mass_g * sliding;
  out[STATE_v5] = base[STATE_v5] - stiffness[3] * w[STATE_x5] - damping[3] * w[STATE_v5] -
                  linear->mass_g * normal;
}

// The transmission error e(t).
SHARED_FN real gear5_error(const ModelPoint* point, const PhaseCoefs* phase) {
  const real error = point->error * phase->sine;
  if (!point->series) return error;
  return error + phase->error;
}

// The force of spring and damper in a bearing; first: its direction across the line of action.
SHARED_FN real gear5_bearing_force(const ModelPoint* point, const real* x, int first) {
  const real* place = x + STATE_x2 + first;
  const real* velocity = x + STATE_v2 + first;
  const real across =
      point->bearing_springs[first] * place[0] + point->bearing_dampers[first] * velocity[0];
  const real along = point->bearing_springs[first + 1] * place[1] +
                     point->bearing_dampers[first + 1] * velocity[1];
  return lane_sqrt(across * across + along * along);
}

// What the dampers of the mesh and of the bearings take from the motion.
SHARED_FN real gear5_damping_power(const ModelPoint* point, const real* x, real rate) {
  const real approach = x[STATE_v1] - x[STATE_v3] + x[STATE_v5];
  const real across = point->bearing_dampers[0] * x[STATE_v2] * x[STATE_v2] +
                      point->bearing_dampers[2] * x[STATE_v4] * x[STATE_v4];
  const real along = point->bearing_dampers[1] * x[STATE_v3] * x[STATE_v3] +
                     point->bearing_dampers[3] * x[STATE_v5] * x[STATE_v5];
  return point->normal_damping * rate * approach + (across + along);
}

SHARED_FN void model_signals(const ModelPoint* point, const PhaseCoefs* phase, const real* x,
                             ModelSignals* signals) {
  ModelContact contact;
  model_contact(point, phase, x, &contact);
  const real rate = gear5_deflection(point, x[STATE_v1], x[STATE_v3], x[STATE_v5]);
  const real f = gear5_penetration(point, &contact);
  const Gear5Mesh mesh = gear5_mesh(point, phase);
  signals->deflection = contact.deflection;
  signals->backlash = contact.backlash;
  signals->dmf = mesh.stiffness * f;
  signals->mesh_stiffness = phase->stiffness;
  signals->friction = mesh.slide_stiffness * f + mesh.slide_damping * rate;
  signals->friction_lever =
      point->friction * phase->lever * f + point->sliding_damping * phase->lever_damping * rate;
  signals->dte = x[STATE_x1] + gear5_error(point, phase);
  signals->bearing_p = gear5_bearing_force(point, x, 0);
  signals->bearing_g = gear5_bearing_force(point, x, 2);
  signals->power_damping = gear5_damping_power(point, x, rate);
  signals->power_friction =
      signals->friction * (x[STATE_v2] - x[STATE_v4]) - signals->friction_lever * x[STATE_v1];
}

#ifdef MODEL_HOST_PART
// From here on host only, in double: what is tabulated or computed once per point.

// The errors beyond the first harmonic, and those that come back once per turn.
struct Gear5Sine {
  double amplitude, order, phase;  // order: periods per mesh period
};

inline std::array<Gear5Sine, 9> gear5_sines(const ModelParameters& p) {
  return {{{p.e0_2, 2.0, p.e0_phase_2},
           {p.e0_3, 3.0, p.e0_phase_3},
           {p.e0_4, 4.0, p.e0_phase_4},
           {p.e0_5, 5.0, p.e0_phase_5},
           {p.e0_6, 6.0, p.e0_phase_6},
           {p.e0_7, 7.0, p.e0_phase_7},
           {p.e0_8, 8.0, p.e0_phase_8},
           {p.runout_p, 1.0 / std::round(p.zp), p.runout_phase_p},
           {p.runout_g, 1.0 / std::round(p.zp * p.teeth_ratio), p.runout_phase_g}}};
}

// What is wrong with a fault of a gear that comes back once per turn; empty if nothing.
inline std::string gear5_check_turn(const ModelParameters& p, const std::string& gear,
                                    double teeth) {
  const double whole = std::round(teeth);
  if (std::fabs(teeth - whole) > 1e-6) {
    return "a fault of the " + gear + " needs a whole number of teeth";
  }
  if (std::fmod(p.cycle, whole) == 0.0) return "";
  return "a fault of the " + gear + " comes back once per turn: cycle must be a multiple of its " +
         std::to_string(static_cast<long>(whole)) + " teeth";
}

// The first thing that is wrong with a set of parameters whose ranges are right; empty if nothing.
inline std::string model_check(const ModelParameters& p, const ModelOptions& options,
                               const ModelCurves& curves = {}) {
  if (std::fabs(p.rho_p + p.rho_g - 1.0) > 1e-6) return "rho_p + rho_g must be 1";
  if (options.formulation == FORMULATION_PRINTED && p.teeth_ratio != 1.0) {
    return "formulation 'printed' is for equal gears: teeth_ratio must be 1";
  }
  if (p.cycle != std::floor(p.cycle)) return "cycle must be a whole number";
  if (options.stiffness == STIFFNESS_TABLE && !curves.measured_stiffness.at) {
    return "stiffness 'table' needs a measured curve: stiffness_file in [gear]";
  }
  if (p.overlap > 0.0 && options.stiffness == STIFFNESS_TABLE && curves.load_share.at) {
    return "the load of helical teeth is shared slice by slice: overlap and load_share_file do not "
           "go together";
  }
  if (p.engagement > 0.0 && (p.overlap > 0.0 || options.stiffness > STIFFNESS_RECTANGULAR)) {
    return "engagement is for spur gears with the stiffness 'parabolic' or 'rectangular'";
  }
  const bool has_pitch = curves.pitch_p.at || curves.pitch_g.at;
  if (options.error != ERROR_SERIES && has_pitch) {
    return "pitch errors need the option error = 'series'";
  }
  if (options.error != ERROR_SERIES) {
    for (const Gear5Sine& sine : gear5_sines(p)) {
      if (sine.amplitude != 0.0) return "e0_2 .. e0_8 and runout need the option error = 'series'";
    }
  }
  if (p.overlap > 0.0 && (curves.damage_curve_p.at || curves.damage_curve_g.at)) {
    return "damage over the path of contact is for spur gears: overlap must be 0";
  }
  std::string wrong;
  if (p.runout_p > 0.0 || p.damage_p > 0.0 || curves.pitch_p.at || curves.damage_curve_p.at)
    wrong = gear5_check_turn(p, "pinion", p.zp);
  if (!wrong.empty()) return wrong;
  if (p.runout_g > 0.0 || p.damage_g > 0.0 || curves.pitch_g.at || curves.damage_curve_g.at) {
    wrong = gear5_check_turn(p, "gear", p.zp * p.teeth_ratio);
  }
  if (!wrong.empty() || !curves.torque_swing.at) return wrong;
  const double teeth = std::round(p.zp);
  if (std::fabs(p.zp - teeth) > 1e-6) {
    return "the torque of a turn needs a whole number of teeth of the pinion";
  }
  if (std::fmod(p.cycle, teeth) == 0.0) return "";
  return "the torque of the pinion comes back once per turn: cycle must be a multiple of its " +
         std::to_string(static_cast<long>(teeth)) + " teeth";
}

// Phases in [0, 1) at which the right-hand side jumps or bends (0 is always one): in each mesh
// period a pair enters, a pair leaves, a pair passes the pitch point; of helical teeth, both ends
// of the face width do. Once per turn, a damaged tooth passes a bend of its curve.
inline std::vector<double> model_break_phases(const ModelParameters& p, const ModelOptions& options,
                                              const ModelCurves& curves = {}) {
  const double pitch = p.approach * p.eps;
  std::vector<double> breaks = {0.0, p.eps - 1.0, pitch < 1.0 ? pitch : pitch - 1.0};
  if (p.overlap > 0.0) {
    for (const double end : {p.overlap, p.eps + p.overlap, pitch + p.overlap}) {
      breaks.push_back(end - std::floor(end));
    }
  }
  if (p.engagement > 0.0) {
    for (const double end : {p.engagement, p.eps - p.engagement}) {
      breaks.push_back(end - std::floor(end));
    }
  }
  if (options.stiffness == STIFFNESS_TABLE) {
    for (const Curve* curve : {&curves.measured_stiffness, &curves.load_share}) {
      breaks.insert(breaks.end(), curve->jumps.begin(), curve->jumps.end());
    }
  }
  std::vector<double> phases;
  for (double begin = 0.0; begin < p.cycle; begin += 1.0) {
    for (const double phase : breaks) phases.push_back((begin + phase) / p.cycle);
  }
  const auto add_bends = [&](const Curve& damage, double teeth) {
    for (double begin = 0.0; begin < p.cycle; begin += std::round(teeth)) {
      for (const double place : damage.jumps) {
        const double phase = (begin + place * 2.0 * p.eps) / p.cycle;
        phases.push_back(phase - std::floor(phase));
      }
    }
  };
  if (!curves.damage_curve_p.jumps.empty()) add_bends(curves.damage_curve_p, p.zp);
  if (!curves.damage_curve_g.jumps.empty()) add_bends(curves.damage_curve_g, p.zp * p.teeth_ratio);
  return phases;
}

// What is left of the stiffness of a pair whose teeth may be damaged. The pair that enters at the
// beginning of the forcing period has both gears' teeth 0; `pair` counts on from there.
inline bool gear5_is_tooth_0(double pair, double teeth) {
  return std::fmod(pair, std::round(teeth)) == 0.0;
}
inline double gear5_sound_share(const ModelParameters& p, double pair) {
  double share = 1.0;
  if (p.damage_p > 0.0 && gear5_is_tooth_0(pair, p.zp)) share *= 1.0 - p.damage_p;
  if (p.damage_g > 0.0 && gear5_is_tooth_0(pair, p.zp * p.teeth_ratio)) share *= 1.0 - p.damage_g;
  return share;
}

// Likewise where the damage is a curve; place: on the path of contact, 0 to 1.
inline double gear5_sound_share_at(const ModelParameters& p, const ModelCurves& curves, double pair,
                                   double place) {
  double share = 1.0;
  if (curves.damage_curve_p.at && gear5_is_tooth_0(pair, p.zp)) {
    share *=
        1.0 - curves.damage_curve_p.at(0.5 * std::fmin(place, 1.0), 0.5 * std::fmin(place, 1.0));
  }
  if (curves.damage_curve_g.at && gear5_is_tooth_0(pair, p.zp * p.teeth_ratio)) {
    share *=
        1.0 - curves.damage_curve_g.at(0.5 * std::fmin(place, 1.0), 0.5 * std::fmin(place, 1.0));
  }
  return share;
}

// Stiffness kappa_i of a pair in contact at position s (in base pitches from its entry).
inline double gear5_pair_stiffness(const ModelParameters& p, int shape, double s) {
  // What the swelling over g base pitches at either end takes from the mean: the integrals of
  // 1 - u^2 (3 - 2 u) and of its first two moments are 1/2, 3/20 and 1/15.
  const double g = p.engagement, q = shape == STIFFNESS_RECTANGULAR ? 0.0 : p.q;
  const double r = 2.0 * g / p.eps;  // offset = r u - 1
  const double lost = 2.0 * g * ((1.0 - q) / 2.0 + q * (2.0 * r * 3.0 / 20.0 - r * r / 15.0));
  const double offset = (s - p.eps / 2.0) / (p.eps / 2.0);
  const double to_end = std::fmin(s, p.eps - s);
  const double u = to_end < g ? to_end / g : 1.0;
  return u * u * (3.0 - 2.0 * u) * (1.0 - q * offset * offset) / (p.eps * (1.0 - q / 3.0) - lost);
}

// Eq. (7): half of the Fourier series of the total stiffness, carried by each pair at all times.
inline double gear5_fourier_stiffness(const ModelParameters& p, double psi) {
  const double turn = TWO_PI * psi;
  return 0.5 *
         (1.0 + p.kappa * std::cos(turn + p.phase) + p.kappa_2 * std::cos(2.0 * turn + p.phase_2) +
          p.kappa_3 * std::cos(3.0 * turn + p.phase_3) +
          p.kappa_4 * std::cos(4.0 * turn + p.phase_4));
}

// All errors of `error` series but the first harmonic; turns: mesh periods since phase 0 of the
// forcing, at a place and inside of the segment that it is the end of.
inline void gear5_add_errors(const ModelParameters& p, const ModelCurves& curves, double turns,
                             double inside, PhaseCoefs* out) {
  const double turn = TWO_PI;
  for (const Gear5Sine& sine : gear5_sines(p)) {
    if (sine.amplitude == 0.0) continue;
    const double error = sine.amplitude * std::sin(turn * sine.order * turns + sine.phase);
    out->error += error;
    out->excitation += sine.order * sine.order * error;
  }
  const auto add_pitch = [&](const Curve& pitch, const Curve& bend, double teeth) {
    if (!pitch.at) return;
    const double order = 1.0 / std::round(teeth);
    out->error += pitch.at(order * turns, order * inside);
    out->excitation += order * order * bend.at(order * turns, order * inside);
  };
  add_pitch(curves.pitch_p, curves.pitch_bend_p, p.zp);
  add_pitch(curves.pitch_g, curves.pitch_bend_g, p.zp * p.teeth_ratio);
}

// Adds a pair in contact at position s, or a slice of it that is a share of its face width.
// lambda: its sliding direction.
inline void gear5_add_pair(const ModelParameters& p, bool printed, double s, double lambda,
                           double kappa, double share, PhaseCoefs* out) {
  // s_p/Rp = tan(alpha) + along and s_g/Rg = tan(alpha) - along Rp/Rg (Eq. 11).
  const double along = (s - p.approach * p.eps) * TWO_PI / p.zp;
  const double pinion_arm = out->tan_alpha + along;
  const double gear_arm = out->tan_alpha - along / p.teeth_ratio;
  const double arm = printed ? gear_arm : p.rho_p * pinion_arm + p.rho_g * gear_arm;
  const double slide_sign = printed ? -lambda : lambda;
  out->stiffness += share * kappa;
  out->lever += lambda * arm * (share * kappa);
  out->lever_damping += share * lambda * arm;
  out->slide += slide_sign * (share * kappa);
  out->slide_damping += share * slide_sign;
}

// Spur teeth: two pairs at most, each at one position.
inline void gear5_add_spur(const ModelParameters& p, const ModelOptions& options,
                           const ModelCurves& curves, bool is_sound, double period, double psi,
                           double inside, PhaseCoefs* out) {
  const bool printed = options.formulation == FORMULATION_PRINTED;
  const bool is_shared = options.stiffness == STIFFNESS_TABLE && curves.load_share.at;
  for (int pair = 0; pair < 2; ++pair) {
    const bool in_contact = inside + pair < p.eps;
    const double lambda = !in_contact ? 0.0 : inside + pair < p.approach * p.eps ? 1.0 : -1.0;
    double kappa = 0.0;
    if (options.stiffness == STIFFNESS_FOURIER) {
      kappa = gear5_fourier_stiffness(p, psi);
    } else if (is_shared) {
      const double last = curves.load_share.at(psi, inside);
      kappa = pair == 0 ? last : 1.0 - last;
    } else if (in_contact) {
      kappa = gear5_pair_stiffness(p, options.stiffness, psi + pair);
    }
    if (!is_sound) {
      kappa *= gear5_sound_share(p, period - pair);
      kappa *= gear5_sound_share_at(p, curves, period - pair, (psi + pair) / p.eps);
    }
    gear5_add_pair(p, printed, psi + pair, lambda, kappa, 1.0, out);
  }
}

// Helical teeth: the slices of a pair are spread over positions from s - overlap to s, and a pair
// has the mean of what they have. Gauss's two points are right for the cubics that are summed.
inline void gear5_add_helical(const ModelParameters& p, const ModelOptions& options, bool is_sound,
                              double period, double psi, PhaseCoefs* out) {
  const bool printed = options.formulation == FORMULATION_PRINTED;
  const double pitch = p.approach * p.eps;
  const double ends[] = {0.0, pitch, p.eps};
  for (double pair = 0.0; pair < p.eps + p.overlap; pair += 1.0) {
    const double sound = is_sound ? 1.0 : gear5_sound_share(p, period - pair);
    for (int side = 0; side < 2; ++side) {
      const double from = std::fmax(ends[side], psi + pair - p.overlap);
      const double to = std::fmin(ends[side + 1], psi + pair);
      if (!(to > from)) continue;
      const double half = 0.5 * (to - from);
      for (const double sign : {-1.0, 1.0}) {
        const double s = from + half * (1.0 + sign / std::sqrt(3.0));
        const double kappa = sound * gear5_pair_stiffness(p, options.stiffness, s);
        gear5_add_pair(p, printed, s, side == 0 ? 1.0 : -1.0, kappa, half / p.overlap, out);
      }
    }
  }
}

// All pairs, with their damage or as if they were sound.
inline void gear5_add_pairs(const ModelParameters& p, const ModelOptions& options,
                            const ModelCurves& curves, bool is_sound, double period, double psi,
                            double inside, PhaseCoefs* out) {
  if (p.overlap > 0.0) {
    gear5_add_helical(p, options, is_sound, period, psi, out);
  } else {
    gear5_add_spur(p, options, curves, is_sound, period, psi, inside, out);
  }
}

// Scales the stiffness of pairs that share `total` as they are, as damage leaves them.
inline void gear5_share_total(const ModelParameters& p, const ModelOptions& options,
                              const ModelCurves& curves, double period, double psi, double inside,
                              double total, PhaseCoefs* out) {
  PhaseCoefs shares = {};
  gear5_add_pairs(p, options, curves, true, period, psi, inside, &shares);
  const double factor = total / shares.stiffness;
  out->stiffness *= factor;
  out->lever *= factor;
  out->slide *= factor;
}

// Coefficients at phase `at` in [0, 1] of the forcing period, as the limit from the side of
// `inside`, a phase strictly between the two break phases that enclose it.
inline PhaseCoefs model_phase_coefs(const ModelParameters& p, const ModelOptions& options,
                                    double at, double at_inside, const ModelCurves& curves = {}) {
  const double turn = TWO_PI;
  const double period = std::floor(p.cycle * at_inside);  // of the mesh
  const double psi = p.cycle * at - period;
  const double inside = p.cycle * at_inside - period;
  const double radians = p.alpha * turn / 360.0;
  PhaseCoefs out = {};
  out.cos_alpha = std::cos(radians);
  out.sin_alpha = std::sin(radians);
  out.tan_alpha = std::tan(radians);
  out.sine = std::sin(turn * psi + p.e0_phase);
  if (options.error == ERROR_SERIES) {
    gear5_add_errors(p, curves, period + psi, period + inside, &out);
  }
  if (curves.torque_swing.at) {
    const double order = 1.0 / std::round(p.zp);
    out.torque =
        p.rho_p * curves.torque_swing.at(order * (period + psi), order * (period + inside));
  }
  gear5_add_pairs(p, options, curves, false, period, psi, inside, &out);
  const bool is_fourier = options.stiffness == STIFFNESS_FOURIER;
  // A table without its curve is what model_check() refuses.
  const bool is_table = options.stiffness == STIFFNESS_TABLE && curves.measured_stiffness.at;
  if (is_table || (is_fourier && p.overlap > 0.0)) {
    const double total = is_fourier ? 2.0 * gear5_fourier_stiffness(p, psi)
                                    : curves.measured_stiffness.at(psi, inside);
    gear5_share_total(p, options, curves, period, psi, inside, total, &out);
  }
  return out;
}

// Static equilibrium on the drive flank under F1 with mean stiffness 1 and no friction.
inline void model_equilibrium(const ModelParameters& p, const ModelOptions& options, double* x) {
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = 0.0;
  x[STATE_x3] = p.F1 / p.k2;
  x[STATE_x5] = -p.F1 / p.k4;
  ModelPoint point;
  model_prepare(&p, options, &point);
  ModelOptions plain = options;  // the angles alone are asked for
  plain.stiffness = STIFFNESS_PARABOLIC;
  plain.error = ERROR_SINE;
  const PhaseCoefs phase = model_phase_coefs(p, plain, 0.0, 1e-9);
  const double shafts = gear5_deflection(&point, 0.0, x[STATE_x3], x[STATE_x5]);
  x[STATE_x1] = gear5_backlash(&point, &phase, x) + p.F1 - shafts;
}
#endif
