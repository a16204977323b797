// What gear5 works out in the inner loop: forces, rates, their slopes, signals.

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
