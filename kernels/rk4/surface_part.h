// Parts of the steps of a model with surfaces (surfaces.h).
#ifndef GEARSWEEP_SURFACE_PART_H
#define GEARSWEEP_SURFACE_PART_H
#ifdef MODEL_SURFACES

// A step's phase coefficients, at its start, in its middle and at its end.
typedef struct {
  PhaseAt row[3];
  TABLE PhaseCoefs* stage;
  real h;     // its length
  real turn;  // the phase, in radians, that it takes
} SurfaceRows;

SHARED_FN SurfaceRows surface_rows(const ModelPoint* point, TABLE PhaseCoefs* stage, real h) {
  const PhaseCoefs start = stage[0];
  const PhaseCoefs middle = stage[1];
  const PhaseCoefs end = stage[2];
  real turn;
  model_phase_turn(point, &turn);
  const SurfaceRows rows = {
      {phase_at(&start), phase_at(&middle), phase_at(&end)}, stage, h, turn * (h / point->period)};
  return rows;
}

// Weights of the rows in the parabola through them, at a share of the step.
SHARED_FN void surface_weights(real share, real* weights) {
  const real one = 1;
  const real two = 2;
  weights[0] = (one - two * share) * (one - share);
  weights[1] = two * two * share * (one - share);
  weights[2] = share * (two * share - one);
}

// The coefficients at a share of a step: the parabola through the rows; of those that surfaces are
// made of (MODEL_PHASE_SLOPES: a coefficient, and that which is its slope) the polynomial of fifth
// degree that has their slopes there, too. A motion that rests on a surface that moves would bounce
// on a parabola, whose speed is wrong by the square of the step.
SHARED_FN void surface_moment(const SurfaceRows* rows, real share, PhaseAt* moment) {
  const real one = 1;
  const real one_half = (scalar)(0.5);
  const real three = 3;
  const real four = 4;
  real weights[3];
  surface_weights(share, weights);
  // 0 at all rows, with the slope 1 at one of them.
  const real bend[3] = {share * weights[0] * weights[0],
                        (share - one_half) * weights[1] * weights[1],
                        (share - one) * weights[2] * weights[2]};
  (void)bend, (void)three, (void)four;
#define SURFACE_BLEND(name, meaning)                                               \
  moment->name = weights[0] * rows->row[0].name + weights[1] * rows->row[1].name + \
                 weights[2] * rows->row[2].name;
#define SURFACE_BEND(name, slope)                                                              \
  moment->name =                                                                               \
      moment->name +                                                                           \
      bend[0] * (rows->turn * rows->row[0].slope -                                             \
                 (four * rows->row[1].name - three * rows->row[0].name - rows->row[2].name)) + \
      bend[1] * (rows->turn * rows->row[1].slope - (rows->row[2].name - rows->row[0].name)) +  \
      bend[2] * (rows->turn * rows->row[2].slope -                                             \
                 (rows->row[0].name + three * rows->row[2].name - four * rows->row[1].name));
  MODEL_PHASE_COEFS(SURFACE_BLEND)
  MODEL_PHASE_SLOPES(SURFACE_BEND)
#undef SURFACE_BLEND
#undef SURFACE_BEND
}

// What a motion that slides shows of its sides: the share as part of a side.
SHARED_FN void surface_show(const ModelPoint* point, const Sliding* sliding, real* shown) {
  const real one = 1;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    const real side = point->sides.side[k];
    const real mixed = side - one + sliding->share[k];
    shown[k] = MODEL_RESETS(k) ? side : lane_select(point->sides.slides[k], mixed, side);
  }
}

SHARED_FN void surface_show_at(const ModelPoint* point, const PhaseAt* moment, const real* x,
                               real* shown) {
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) shown[k] = point->sides.side[k];
  if (all_lanes(!sliding_any(point))) return;
  Sliding sliding;
  sliding_find(point, moment, x, &sliding);
  surface_show(point, &sliding, shown);
}

// A part of a step, from one of its shares on, with the states and slopes at its ends.
typedef struct {
  const SurfaceRows* rows;
  scalar share;    // the step's, of the period
  real from;       // the share of the step at which it begins
  const real* to;  // that at which it ends
  real length;     // in time
  const PhaseAt *start, *middle, *end;
  const real *x, *next;
  const Rk4Slopes* slopes;
} SurfacePart;

// The state at a share of the part, by Hermite's cubic.
SHARED_FN void surface_inside(const SurfacePart* part, real t, real* x) {
  const real one = 1;
  const real two = 2;
  const real three = 3;
  const real end = t * t * (three - two * t);
  const real first = part->length * t * (one - t) * (one - t);
  const real last = part->length * t * t * (t - one);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    x[i] = part->x[i] + (end * (part->next[i] - part->x[i]) +
                         (first * part->slopes->first[i] + last * part->slopes->last[i]));
  }
}

#endif
#endif
