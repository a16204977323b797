// One step of the classical fourth-order Runge-Kutta method on the phase grid. The model's phase
// coefficients come from a table: stage[0] at the step's start, stage[1] in its middle, stage[2] at
// its end; the next step of the same segment starts at stage[2].

#define RK4_STAGES_PER_STEP 2
#define RK4_EVALUATIONS 4

#include "rk4/crossing.h"

// In a model without contact there is nothing to see.
#ifndef MODEL_CONTACT
typedef int ContactSeen;
typedef int Crossings;
#endif

#include "rk4/sliding.h"

// dx = dx/dtau.
SHARED_FN void rk4_slope(const ModelPoint* point, const PhaseAt* phase, const real* x,
                         ContactSeen* seen, real* dx) {
#ifdef MODEL_CONTACT
  model_contact(point, phase, x, seen->at);
  model_rhs_in_contact(point, phase, x, seen->at, dx);
#else
  (void)seen;
  model_rhs(point, phase, x, dx);
#endif
#ifdef MODEL_SURFACES
  sliding_slope(point, phase, x, dx);
#endif
}

// out = base + h slope.
SHARED_FN void rk4_advance(const real* base, real h, const real* slope, real* out) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) out[i] = base[i] + h * slope[i];
}

// The state in the middle of a step, (x0 + x1)/2 + h/8 (dx0 - dx1), where dx1 is the last
// evaluation's, which is good to third order. First the slopes alone, so that a motion at rest
// stays where it is to the last bit.
SHARED_FN void rk4_middle_begin(real h, const real* slope, real* middle) {
  const real eighth_h = (scalar)(0.125) * h;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) middle[i] = eighth_h * slope[i];
}
SHARED_FN void rk4_middle_end(const real* x, const real* end, real h, const real* slope,
                              real* middle) {
  const real eighth_h = (scalar)(0.125) * h;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real bow = middle[i] - eighth_h * slope[i];
    middle[i] = x[i] + ((scalar)(0.5) * (end[i] - x[i]) + bow);
  }
}

// The lengths of a step's parts.
typedef struct {
  real half_h, third_h, sixth_h;
} Rk4Lengths;

SHARED_FN Rk4Lengths rk4_lengths(real h) {
  Rk4Lengths lengths;
  lengths.half_h = (scalar)(0.5) * h;
  lengths.third_h = (scalar)(1.0 / 3.0) * h;
  lengths.sixth_h = (scalar)(1.0 / 6.0) * h;
  return lengths;
}

// What a step gives beside its end: a sum of these. What is not asked for may be null (walk.h).
enum {
  RK4_MIDDLE = 1,  // the state in its middle: that of Hermite's cubic through both ends, of fourth
                   // order locally
  RK4_LINEAR = 2,  // the linearisation at each of the RK4_EVALUATIONS, times h/2, h/2, h and h/6,
                   // as rk4_tangent_step wants it
  RK4_CORRECTED = 4  // a step in which a limit of the contact is crossed is corrected
};

// What is known of the model's field at both ends of a step, and on the way.
typedef struct {
  real first[MODEL_STATE_COUNT], last[MODEL_STATE_COUNT];  // last: to third order
} Rk4Slopes;

// The state h (dimensionless time) after x.
SHARED_FN void rk4_advance_by(const ModelPoint* point, const PhaseAt* start, const PhaseAt* middle,
                              const PhaseAt* end, real h, int beside, const real* x, real* next,
                              Rk4Slopes* slopes, ModelLinear* linear, Crossings* crossings) {
  const bool is_linear = beside & RK4_LINEAR;
  const Rk4Lengths lengths = rk4_lengths(h);
  real slope[MODEL_STATE_COUNT];
  real at[MODEL_STATE_COUNT];
  ContactSeen seen[RK4_EVALUATIONS];

  if (is_linear) model_linearize(point, start, x, lengths.half_h, &linear[0]);
  rk4_slope(point, start, x, &seen[0], slopes->first);
  rk4_advance(x, lengths.sixth_h, slopes->first, next);
  rk4_advance(x, lengths.half_h, slopes->first, at);
  if (is_linear) model_linearize(point, middle, at, lengths.half_h, &linear[1]);
  rk4_slope(point, middle, at, &seen[1], slope);
  rk4_advance(next, lengths.third_h, slope, next);
  rk4_advance(x, lengths.half_h, slope, at);
  if (is_linear) model_linearize(point, middle, at, h, &linear[2]);
  rk4_slope(point, middle, at, &seen[2], slope);
  rk4_advance(next, lengths.third_h, slope, next);
  rk4_advance(x, h, slope, at);
  if (is_linear) model_linearize(point, end, at, lengths.sixth_h, &linear[3]);
  rk4_slope(point, end, at, &seen[3], slopes->last);
  rk4_advance(next, lengths.sixth_h, slopes->last, next);
#ifdef MODEL_CONTACT
  if (beside & RK4_CORRECTED) {
    crossings_correct(point, start, end, h, seen, x, next, crossings);
  }
#endif
}

#ifndef MODEL_SURFACES

// Advances x by h (dimensionless time).
SHARED_FN void rk4_step_linearized(const ModelPoint* point, TABLE PhaseCoefs* stage, real h,
                                   int beside, real* x, real* middle_state, ModelLinear* linear,
                                   Crossings* crossings) {
  const PhaseCoefs start = stage[0];
  const PhaseCoefs middle = stage[1];
  const PhaseCoefs end = stage[2];
  real next[MODEL_STATE_COUNT];
  Rk4Slopes slopes;
  rk4_advance_by(point, &start, &middle, &end, h, beside, x, next, &slopes, linear, crossings);
  if (beside & RK4_MIDDLE) {
    rk4_middle_begin(h, slopes.first, middle_state);
    rk4_middle_end(x, next, h, slopes.last, middle_state);
  }
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = next[i];
}

// Advances x by h, without its linearisation.
SHARED_FN void rk4_step(const ModelPoint* point, TABLE PhaseCoefs* stage, real h, int beside,
                        real* x, real* middle) {
  Crossings crossings;
  rk4_step_linearized(point, stage, h, beside, x, middle, 0, &crossings);
}

#endif

// With MODEL_SECOND_ORDER a model says that the first half of its states are positions, the second
// half their velocities in the same order. Any model may be without it; positions then take a
// longer way through rk4_tangent_step.
#ifdef MODEL_SECOND_ORDER
#define RK4_POSITIONS (MODEL_STATE_COUNT / 2)
#else
#define RK4_POSITIONS 0
#endif

// Advances a tangent vector w by the same step: the derivative of the discrete map along w. With J
// the Jacobians at the evaluations, the vectors
//   w2 = w + h/2 J1 w, w3 = w + h/2 J2 w2, w4 = w + h J3 w3
// hold all that the sum of the slopes would:
//   w' = (w2 + 2 w3 + w4 - w)/3 + h/6 J4 w4,
// and for positions x with velocities v (Nystroem's form)
//   x' = x3 + h/6 (v4 + 2 v3 - (v2 - v)).
// Without slopes and running sums one vector fits into a CPU's registers. `beside`, `linear` and
// `crossings` as the step of the state had and left them.
SHARED_FN void rk4_tangent_step(const ModelPoint* point, real h, int beside,
                                const ModelLinear* linear, const Crossings* crossings, real* w) {
  const real sixth_h = rk4_lengths(h).sixth_h;
  const real third = (scalar)(1.0 / 3.0);
  const real two = 2;
  real zeros[MODEL_STATE_COUNT];
  real w2[MODEL_STATE_COUNT];
  real w3[MODEL_STATE_COUNT];
  real w4[MODEL_STATE_COUNT];
  real last[MODEL_STATE_COUNT];

  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) zeros[i] = 0;
  model_tangent(point, &linear[0], w, w, w2);
  model_tangent(point, &linear[1], w2, w, w3);
  model_tangent(point, &linear[2], w3, w, w4);
  model_tangent(point, &linear[3], w4, zeros, last);
#ifdef MODEL_CONTACT
  ContactSeen added[RK4_EVALUATIONS];
  model_contact_tangent(point, &linear[0], w, added[0].at);
  model_contact_tangent(point, &linear[1], w2, added[1].at);
  model_contact_tangent(point, &linear[2], w3, added[2].at);
  model_contact_tangent(point, &linear[3], w4, added[3].at);
#endif
  UNROLL
  for (int i = 0; i < RK4_POSITIONS; ++i) {
    const int v = RK4_POSITIONS + i;
    w[i] = w3[i] + sixth_h * ((w4[v] + two * w3[v]) - (w2[v] - w[v]));
  }
  UNROLL
  for (int i = RK4_POSITIONS; i < MODEL_STATE_COUNT; ++i) {
    w[i] = last[i] + third * ((w4[i] + two * w3[i]) + (w2[i] - w[i]));
  }
#ifdef MODEL_CONTACT
  if (beside & RK4_CORRECTED) crossings_correct_tangent(point, crossings, added, w);
#endif
}
