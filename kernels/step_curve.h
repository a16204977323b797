// A quantity inside a step, as the cubic through its values at four moments (observe.h):
// middle + b t + a t^2 + c (t^3 - t), where t is -1 at the step's start and 1 at its end.

typedef struct {
  real middle, a, b, c;
} StepCurve;

// cubic: 1/6, or 0 where `earlier` does not count; then it is a parabola.
SHARED_FN StepCurve step_curve(real earlier, real before, real middle, real after, real cubic) {
  const real one_half = (scalar)(0.5);
  StepCurve curve;
  curve.middle = middle;
  curve.a = one_half * ((before - middle) + (after - middle));
  curve.b = one_half * (after - before);
  curve.c = cubic * ((after - earlier) + (scalar)(3) * (before - middle));
  return curve;
}

SHARED_FN real step_curve_at(const StepCurve* curve, real t) {
  const real one = 1;
  return curve->middle + t * (curve->b + curve->a * t + curve->c * (t * t - one));
}

SHARED_FN real step_curve_slope(const StepCurve* curve, real t) {
  return (curve->b - curve->c) + t * ((scalar)(2) * curve->a + (scalar)(3) * curve->c * t);
}

// Whether the slopes at the step's ends, b + 2 c - 2 a and b + 2 c + 2 a, differ in sign: then
// there is one extremum between them.
SHARED_FN mask step_curve_turns(const StepCurve* curve) {
  const real two = 2;
  return lane_abs(curve->b + two * curve->c) < two * lane_abs(curve->a);
}

// The place of that extremum, in the lanes of `turns`; in others 1. Of the slope's two zeros it is
// the one nearer to the middle, here without cancellation.
SHARED_FN real step_curve_turn(const StepCurve* curve, mask turns) {
  const real zero = 0;
  const real one = 1;
  const real square = curve->a * curve->a - (scalar)(3) * curve->c * (curve->b - curve->c);
  const real root = lane_sqrt(lane_max(square, zero));
  const real sum = lane_select(curve->a < zero, curve->a - root, curve->a + root);
  return lane_select(turns, (curve->c - curve->b) / lane_select(turns, sum, one), one);
}
