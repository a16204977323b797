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
  X(overlap, "1", 0.0, 0.0, 10.0, 1, "overlap ratio of helical teeth")                            \
  X(stiffness_factor, "1", 1.0, 1e-3, 1e3, 1,                                                     \
    "what the stiffness of all pairs is multiplied by; k0 is that without it")

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

#include "equations/headers/gear5/field.h"
#ifdef MODEL_HOST_PART
#include "equations/headers/gear5/mesh.h"
#endif
