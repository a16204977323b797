// Where a level, of which both values and slopes are known at the ends of a part of a step, goes
// through a bound.
#ifndef GEARSWEEP_LEVEL_CROSS_H
#define GEARSWEEP_LEVEL_CROSS_H

// A share of the distance that a level goes in a step, which rounding does not make.
#define LEVEL_NEAR ((scalar)(REAL_BITS == 64 ? 1e-9 : 1e-4))

// The cubic of a level over a part of a step: its values and slopes at both ends.
typedef struct {
  real value, slope, square, cube;
} LevelCurve;

SHARED_FN real level_curve_at(const LevelCurve* curve, real t) {
  return curve->value + t * (curve->slope + t * (curve->square + t * curve->cube));
}

// Whether the cubic may go above `up` or below `down`: it lies between the control points of its
// Bezier form. Cheaper than level_cross(), which need not be asked where this says no.
SHARED_FN mask level_may_cross(real l0, real l1, real r0, real r1, real up, real down) {
  const real third = (scalar)(1.0 / 3.0);
  const real inner = l0 + third * r0;
  const real outer = l1 - third * r1;
  const real low = lane_min(lane_min(l0, l1), lane_min(inner, outer));
  const real high = lane_max(lane_max(l0, l1), lane_max(inner, outer));
  return !((low >= down) & (high <= up));
}

// Where a level first goes above `up` or below `down`; false where it does not. l, r: the level
// and its slope at the part's start and end.
SHARED_FN mask level_cross(real l0, real l1, real r0, real r1, real up, real down, real* after,
                           mask* is_up) {
  const real zero = 0;
  const real one = 1;
  const real two = 2;
  const real three = 3;
  const real change = l1 - l0;
  const LevelCurve curve = {l0, r0, three * change - two * r0 - r1, r0 + r1 - two * change};
  // A turn inside the part counts from a distance that rounding does not make.
  const real told = LEVEL_NEAR * (lane_abs(change) + lane_abs(r0) + lane_abs(r1));
  const real under_root = curve.square * curve.square - three * curve.cube * curve.slope;
  const real root = lane_sqrt(lane_max(under_root, zero));
  const real q = -(curve.square + lane_select(curve.square < zero, -root, root));
  const real one_turn = q / (three * curve.cube);
  const real other_turn = curve.slope / q;
  const mask turns = zero < under_root;
  const real a = lane_select(turns & (zero < one_turn) & (one_turn < one), one_turn, one);
  const real b = lane_select(turns & (zero < other_turn) & (other_turn < one), other_turn, one);
  const real first = lane_min(a, b);
  const real second = lane_max(a, b);
  const real at_first = level_curve_at(&curve, first);
  const real at_second = level_curve_at(&curve, second);
  const mask first_up = up + told < at_first;
  const mask first_hit = first_up | (at_first < down - told);
  const mask second_up = up + told < at_second;
  const mask second_hit = second_up | (at_second < down - told);
  const mask end_up = up < l1;
  const mask end_hit = end_up | (l1 < down);
  const mask hit = first_hit | second_hit | end_hit;
  *after = one;
  *is_up = (first_hit & first_up) | (second_hit & second_up & !first_hit) |
           (end_up & !first_hit & !second_hit);
  if (all_lanes(!hit)) return hit;
  real low = lane_select(first_hit, zero, lane_select(second_hit, first, second));
  real high = lane_select(first_hit, first, lane_select(second_hit, second, one));
  const real limit = lane_select(*is_up, up, down);
  const mask rises = *is_up;
  for (int i = 0; i < 8; ++i) {
    const real middle = (scalar)(0.5) * (low + high);
    const real value = level_curve_at(&curve, middle);
    const mask is_beyond = (rises & (limit < value)) | (!rises & (value < limit));
    high = lane_select(is_beyond, middle, high);
    low = lane_select(is_beyond, low, middle);
  }
  real t = (scalar)(0.5) * (low + high);
  for (int i = 0; i < 3; ++i) {
    const real slope = curve.slope + t * (two * curve.square + three * curve.cube * t);
    const real next = t - (level_curve_at(&curve, t) - limit) / slope;
    t = lane_select(slope != zero, lane_clamp(next, low, high), t);
  }
  *after = lane_select(hit, t, one);
  return hit;
}

#endif
