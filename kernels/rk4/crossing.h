// Steps in which a model with contact (MODEL_CONTACT) crosses a limit of a backlash or a stop. The
// field is continuous there, but its derivative jumps, and so a Runge-Kutta step leaves an error of
// second order in its length. Its leading parts are known in closed form: along the smooth
// continuation of the motion from the step's start, the penetration p is the parabola through what
// the evaluations saw; from its root on the force differs by |p|. With u the share of the step, m
// the slope that a unit of force gives and J the Jacobian behind the crossing, that moves the
// step's end by
//   h integral(m p du) + h^2 J m integral((1 - u) p du)
// where the evaluations, with weights 1/6, 1/3, 1/3, 1/6, saw sums instead of integrals. Adding the
// difference leaves an error of fourth order. Once a limit is crossed back within the same step,
// nothing is seen. Each flank has its own limit and its own penetration, D - b' and D + b', whose
// corrections add up: where the backlash is negative both flanks touch at once. So do those of
// several contacts.
//
// Where a force changes the rate of its own penetration (MODEL_CONTACT_FEEDBACK: no model in which
// penetrations depend on positions and forces act on velocities), the evaluations behind the
// crossing saw another p than the smooth continuation has: by h m grad(p) times half of the second
// evaluation's p in the third, and all of the third's in the fourth.

#ifdef MODEL_CONTACT

// One flank's limit.
typedef struct {
  bool any;        // a lane crosses it; otherwise the rest is not set
  real turn;       // 1: crossed into contact, -1: out of it, 0: not crossed in this step
  real after;      // share of the step that lies behind the crossing
  real beyond[3];  // 1 where the second, third, fourth evaluation lies behind it
#ifdef MODEL_CONTACT_FEEDBACK
  real feedback;  // what a unit of p adds to p within a step
#endif
} Crossing;

// One contact's limits.
typedef struct {
  bool any;  // a lane crosses a limit; otherwise the rest is not set
  Crossing drive, back;
  // The step's end moves by direction times the integral of p plus carry times that of (1 - u) p.
  real direction[MODEL_STATE_COUNT], carry[MODEL_STATE_COUNT];
#ifdef MODEL_FORCE_DIRECTION_VARIES
  real sum, moment;  // of both flanks: those integrals, less what the evaluations saw of them
#endif
} ContactCrossings;

typedef struct {
  ContactCrossings contact[MODEL_CONTACTS];
#ifdef MODEL_FORCE_DIRECTION_VARIES
  // Where the direction depends on the state, a tangent vector turns it: what it is added to.
  PhaseAt start, end;
  real from[MODEL_STATE_COUNT], to[MODEL_STATE_COUNT];
  real h;
#endif
} Crossings;

// Where the contacts stand at one evaluation, or what a tangent vector adds to that.
typedef struct {
  ModelContact at[MODEL_CONTACTS];
} ContactSeen;

// Integral of p and of (1 - u) p behind the crossing, less what the evaluations saw of them; p
// changes its sign for a flank that is left.
SHARED_FN void crossing_defect(const Crossing* crossing, const real* p, real* sum, real* moment) {
  const real one_half = (scalar)(0.5);
  const real third = (scalar)(1.0 / 3.0);
  const real sixth = (scalar)(1.0 / 6.0);
  const real after = crossing->after;
  // p = p[3] + slope r + bend r^2 with r = 1 - u; the two in the middle have opposite errors there.
  const real middle = one_half * (p[1] + p[2]);
  const real bend = (scalar)(2) * ((p[0] - middle) + (p[3] - middle));
  const real slope = (p[0] - p[3]) - bend;
  const real whole = after * (p[3] + after * (one_half * slope + after * (third * bend)));
  const real lever =
      after * after * (one_half * p[3] + after * (third * slope + after * ((scalar)(0.25) * bend)));
  const real seen = crossing->beyond[0] * p[1] + crossing->beyond[1] * p[2];
  *sum = crossing->turn * (whole - third * seen - sixth * (crossing->beyond[2] * p[3]));
  *moment = crossing->turn * (lever - sixth * seen);
}

// Corrects a state with its p at the evaluations, or a tangent vector with the derivatives of p
// along it: the crossing moves, too, but p is 0 there. Writes the integrals as crossing_defect()
// does, with 0 where nothing is crossed.
SHARED_FN void crossing_correct(const ContactCrossings* contact, const Crossing* crossing,
                                const real* p, real* x, real* sum, real* moment) {
  const real zero = 0;
  crossing_defect(crossing, p, sum, moment);
  const mask is_crossed = zero < crossing->turn * crossing->turn;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real moved = x[i] + (contact->direction[i] * *sum + contact->carry[i] * *moment);
    x[i] = lane_select(is_crossed, moved, x[i]);
  }
  *sum = lane_select(is_crossed, *sum, zero);
  *moment = lane_select(is_crossed, *moment, zero);
}

// Takes what the force behind the crossing did to p out of p.
SHARED_FN void crossing_clean(const Crossing* crossing, real* p) {
#ifdef MODEL_CONTACT_FEEDBACK
  const real gain = crossing->turn * crossing->feedback;
  const real third = p[2];
  p[2] = p[2] - (scalar)(0.5) * gain * (crossing->beyond[0] * p[1]);
  p[3] = p[3] - gain * (crossing->beyond[1] * third);
#else
  (void)crossing;
  (void)p;
#endif
}

// Finds the crossing of one flank's limit (flank 1: drive, -1: back); p is the deflection beyond it
// at each evaluation.
SHARED_FN void crossing_locate(real flank, Crossing* crossing, real* p) {
  const real zero = 0;
  const real one = 1;
  const real before = flank * p[0];
  const real behind = flank * p[RK4_EVALUATIONS - 1];
  crossing->any = !all_lanes((zero < before) == (zero < behind));
  if (!crossing->any) return;
  const real turn = lane_select(zero < behind, one, zero) - lane_select(zero < before, one, zero);
  UNROLL
  for (int i = 0; i < 3; ++i) {
    crossing->beyond[i] = lane_select(zero < turn * flank * p[i + 1], one, zero);
  }
  crossing->turn = turn;
  crossing_clean(crossing, p);
  real ahead[RK4_EVALUATIONS];  // below 0 before the crossing, above 0 behind it
  UNROLL
  for (int i = 0; i < RK4_EVALUATIONS; ++i) ahead[i] = turn * flank * p[i];
  // ahead = ahead[3] + slope r + bend r^2 with r = 1 - u. Of its two roots one lies in the step.
  // Both ways of writing it divide by, or of, a sum whose terms have the same sign; where the
  // motion only touches the limit at the step's end, that sum may be 0, and nothing lies behind the
  // crossing.
  const real twice_bend = (scalar)(4) * ((ahead[0] - ahead[1]) + (ahead[3] - ahead[2]));
  const real slope = (ahead[0] - ahead[3]) - (scalar)(0.5) * twice_bend;
  const real square = slope * slope - (scalar)(2) * twice_bend * ahead[3];
  const real sum = lane_sqrt(lane_max(square, zero)) + lane_abs(slope);
  const mask rises = zero < slope;
  const real over = lane_select(rises, -twice_bend, sum);
  const real share = lane_select(rises, sum, (scalar)(2) * ahead[3]) / over;
  crossing->after = lane_select(zero < over, share, zero);
#ifdef MODEL_CONTACT_FEEDBACK
  // The smooth continuation may fall short of the limit, or pass it twice.
  crossing->after = lane_clamp(crossing->after, zero, one);
#endif
}

// p of a contact's flank at each evaluation, or the derivatives of p.
SHARED_FN void crossing_beyond(const ContactSeen* seen, int contact, real flank, real* p) {
  UNROLL
  for (int i = 0; i < RK4_EVALUATIONS; ++i) {
    p[i] = seen[i].at[contact].deflection - flank * seen[i].at[contact].backlash;
  }
}

// Corrects the end x of a step for the crossings of one flank's limit.
SHARED_FN void crossing_apply(ContactCrossings* crossings, const ContactSeen* seen, int contact,
                              real flank, Crossing* crossing, real* x) {
  real p[RK4_EVALUATIONS];
  crossing_beyond(seen, contact, flank, p);
  real sum;
  real moment;
  crossing_locate(flank, crossing, p);
  if (!crossing->any) return;
  crossing_correct(crossings, crossing, p, x, &sum, &moment);
#ifdef MODEL_FORCE_DIRECTION_VARIES
  crossings->sum = crossings->sum + sum;
  crossings->moment = crossings->moment + moment;
#endif
}

// Whether a lane crosses a limit of a contact between the first evaluation and the last.
SHARED_FN bool crossings_any(const ContactSeen* seen, int contact) {
  const ModelContact* a = &seen[0].at[contact];
  const ModelContact* b = &seen[RK4_EVALUATIONS - 1].at[contact];
  const mask drive = (a->backlash < a->deflection) == (b->backlash < b->deflection);
  if (MODEL_ONE_SIDED(contact)) return !all_lanes(drive);
  const mask back = (a->deflection < -a->backlash) == (b->deflection < -b->backlash);
  return !all_lanes(drive & back);
}

// How the end of a step from x0 to x1 moves with the integrals of p.
SHARED_FN void crossings_aim(const ModelPoint* point, const PhaseAt* start, const PhaseAt* end,
                             real h, const real* x0, const real* x1, int contact,
                             ContactCrossings* crossings) {
  real before[MODEL_STATE_COUNT];
  real carried[MODEL_STATE_COUNT];

  model_force_direction(point, start, x0, contact, before);
  model_force_direction(point, end, x1, contact, crossings->direction);
  model_force_direction_carried(point, end, x1, crossings->direction, carried);
#ifdef MODEL_CONTACT_FEEDBACK
  ModelContact along[MODEL_CONTACTS];
  model_contact_along(point, end, x1, crossings->direction, along);
  crossings->drive.feedback = h * (along[contact].deflection - along[contact].backlash);
  crossings->back.feedback = h * (along[contact].deflection + along[contact].backlash);
#endif
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    crossings->carry[i] = h * ((before[i] - crossings->direction[i]) + h * carried[i]);
    crossings->direction[i] = h * crossings->direction[i];
  }
}

// Corrects the end x1 of a step from x0 from what its evaluations saw, and keeps what
// rk4_tangent_step needs for the same.
SHARED_FN void crossings_correct(const ModelPoint* point, const PhaseAt* start, const PhaseAt* end,
                                 real h, const ContactSeen* seen, const real* x0, real* x1,
                                 Crossings* crossings) {
  const real one = 1;
#ifdef MODEL_FORCE_DIRECTION_VARIES
  crossings->start = *start;
  crossings->end = *end;
  crossings->h = h;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    crossings->from[i] = x0[i];
    crossings->to[i] = x1[i];
  }
#endif
  UNROLL
  for (int i = 0; i < MODEL_CONTACTS; ++i) {
    ContactCrossings* contact = &crossings->contact[i];
    contact->any = crossings_any(seen, i);
    if (!contact->any) continue;
#ifdef MODEL_FORCE_DIRECTION_VARIES
    contact->sum = 0;
    contact->moment = 0;
#endif
    crossings_aim(point, start, end, h, x0, x1, i, contact);
    crossing_apply(contact, seen, i, one, &contact->drive, x1);
    if (!MODEL_ONE_SIDED(i)) crossing_apply(contact, seen, i, -one, &contact->back, x1);
  }
}

// Corrects the end w of a tangent vector's step from what it added to the contact at the
// evaluations, for the crossings of one flank's limit.
SHARED_FN void crossing_apply_tangent(const ContactCrossings* crossings, const ContactSeen* added,
                                      int contact, real flank, const Crossing* crossing, real* w) {
  real p[RK4_EVALUATIONS];
  real sum;
  real moment;
  if (!crossing->any) return;
  crossing_beyond(added, contact, flank, p);
  crossing_clean(crossing, p);
  crossing_correct(crossings, crossing, p, w, &sum, &moment);
}

// What a tangent vector's turning of the force's direction adds to the end w of its step. The rest
// of that, the turning of what is carried, is of third order in the step's length.
SHARED_FN void crossing_turn_tangent(const ModelPoint* point, const Crossings* crossings,
                                     int contact, real* w) {
#ifdef MODEL_FORCE_DIRECTION_VARIES
  const real sum = crossings->contact[contact].sum;
  const real moment = crossings->contact[contact].moment;
  real before[MODEL_STATE_COUNT];
  real behind[MODEL_STATE_COUNT];
  model_force_direction_tangent(point, &crossings->start, crossings->from, contact, w, before);
  model_force_direction_tangent(point, &crossings->end, crossings->to, contact, w, behind);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    w[i] = w[i] + crossings->h * (behind[i] * sum + (before[i] - behind[i]) * moment);
  }
#else
  (void)point;
  (void)crossings;
  (void)contact;
  (void)w;
#endif
}

SHARED_FN void crossings_correct_tangent(const ModelPoint* point, const Crossings* crossings,
                                         const ContactSeen* added, real* w) {
  const real one = 1;
  UNROLL
  for (int i = 0; i < MODEL_CONTACTS; ++i) {
    const ContactCrossings* contact = &crossings->contact[i];
    if (!contact->any) continue;
    crossing_turn_tangent(point, crossings, i, w);
    crossing_apply_tangent(contact, added, i, one, &contact->drive, w);
    if (MODEL_ONE_SIDED(i)) continue;
    crossing_apply_tangent(contact, added, i, -one, &contact->back, w);
  }
}

#endif
