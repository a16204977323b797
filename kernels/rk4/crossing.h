// Steps in which a model with contact (MODEL_CONTACT) crosses a limit of its backlash. The field is
// continuous there, but its derivative jumps, and so a Runge-Kutta step leaves an error of second
// order in its length. Its leading parts are known in closed form: along the smooth continuation of
// the motion from the step's start, the penetration p is the parabola through what the evaluations
// saw; from its root on the force differs by |p|. With u the share of the step, m the slope that a
// unit of force gives and J the Jacobian, that moves the step's end by
//   h integral(m p du) + h^2 J m integral((1 - u) p du)
// where the evaluations, with weights 1/6, 1/3, 1/3, 1/6, saw sums instead of integrals. Adding the
// difference leaves an error of fourth order. Once a limit is crossed back within the same step,
// nothing is seen. Each flank has its own limit and its own penetration, D - b' and D + b', whose
// corrections add up: where the backlash is negative both flanks touch at once. All this asks for a
// penetration that depends on positions and a direction on velocities.

#ifdef MODEL_CONTACT

// One flank's limit.
typedef struct {
  bool any;        // a lane crosses it; otherwise the rest is not set
  real turn;       // 1: crossed into contact, -1: out of it, 0: not crossed in this step
  real after;      // share of the step that lies behind the crossing
  real beyond[3];  // 1 where the second, third, fourth evaluation lies behind it
} Crossing;

typedef struct {
  bool any;  // a lane crosses a limit; otherwise the rest is not set
  Crossing drive, back;
  // The step's end moves by direction times the integral of p plus carry times that of (1 - u) p.
  real direction[MODEL_STATE_COUNT], carry[MODEL_STATE_COUNT];
} Crossings;

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
// along it: the crossing moves, too, but p is 0 there.
SHARED_FN void crossing_correct(const Crossings* crossings, const Crossing* crossing, const real* p,
                                real* x) {
  if (!crossing->any) return;
  const real zero = 0;
  real sum;
  real moment;
  crossing_defect(crossing, p, &sum, &moment);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real moved = x[i] + (crossings->direction[i] * sum + crossings->carry[i] * moment);
    x[i] = lane_select(zero < crossing->turn * crossing->turn, moved, x[i]);
  }
}

// Finds the crossing of one flank's limit (flank 1: drive, -1: back); p is the deflection beyond it
// at each evaluation.
SHARED_FN void crossing_locate(const real* p, real flank, Crossing* crossing) {
  const real zero = 0;
  const real one = 1;
  const real before = flank * p[0];
  const real behind = flank * p[RK4_EVALUATIONS - 1];
  crossing->any = !all_lanes((zero < before) == (zero < behind));
  if (!crossing->any) return;
  const real turn = lane_select(zero < behind, one, zero) - lane_select(zero < before, one, zero);
  real ahead[RK4_EVALUATIONS];  // below 0 before the crossing, above 0 behind it
  UNROLL
  for (int i = 0; i < RK4_EVALUATIONS; ++i) ahead[i] = turn * flank * p[i];
  UNROLL
  for (int i = 0; i < 3; ++i) crossing->beyond[i] = lane_select(zero < ahead[i + 1], one, zero);
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
  crossing->turn = turn;
  crossing->after = lane_select(zero < over, share, zero);
}

// p of a flank from the contact at each evaluation, or the derivatives of p from those of the
// contact.
SHARED_FN void crossing_beyond(const ModelContact* contact, real flank, real* p) {
  UNROLL
  for (int i = 0; i < RK4_EVALUATIONS; ++i) {
    p[i] = contact[i].deflection - flank * contact[i].backlash;
  }
}

// Corrects the end x of a step for the crossings of one flank's limit.
SHARED_FN void crossing_apply(const Crossings* crossings, const ModelContact* contact, real flank,
                              Crossing* crossing, real* x) {
  real p[RK4_EVALUATIONS];
  crossing_beyond(contact, flank, p);
  crossing_locate(p, flank, crossing);
  crossing_correct(crossings, crossing, p, x);
}

// Whether a lane crosses a limit between the first evaluation and the last.
SHARED_FN bool crossings_any(const ModelContact* contact) {
  const ModelContact* a = &contact[0];
  const ModelContact* b = &contact[RK4_EVALUATIONS - 1];
  const mask drive = (a->backlash < a->deflection) == (b->backlash < b->deflection);
  const mask back = (a->deflection < -a->backlash) == (b->deflection < -b->backlash);
  return !all_lanes(drive & back);
}

// Corrects the end x of a step from what its evaluations saw, and keeps what rk4_tangent_step needs
// for the same.
SHARED_FN void crossings_correct(const ModelPoint* point, const PhaseCoefs* start,
                                 const PhaseCoefs* end, real h, const ModelContact* contact,
                                 real* x, Crossings* crossings) {
  crossings->any = crossings_any(contact);
  if (!crossings->any) return;
  const real one = 1;
  real before[MODEL_STATE_COUNT];
  real carried[MODEL_STATE_COUNT];

  model_force_direction(point, start, before);
  model_force_direction(point, end, crossings->direction);
  model_force_direction_carried(point, end, crossings->direction, carried);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    crossings->carry[i] = h * ((before[i] - crossings->direction[i]) + h * carried[i]);
    crossings->direction[i] = h * crossings->direction[i];
  }
  crossing_apply(crossings, contact, one, &crossings->drive, x);
  crossing_apply(crossings, contact, -one, &crossings->back, x);
}

// Corrects the end w of a tangent vector's step from what it added to the contact at the
// evaluations.
SHARED_FN void crossings_correct_tangent(const Crossings* crossings, const ModelContact* added,
                                         real* w) {
  if (!crossings->any) return;
  const real one = 1;
  real drive[RK4_EVALUATIONS];
  real back[RK4_EVALUATIONS];
  crossing_beyond(added, one, drive);
  crossing_beyond(added, -one, back);
  crossing_correct(crossings, &crossings->drive, drive, w);
  crossing_correct(crossings, &crossings->back, back, w);
}

#endif
