// What a flank does inside a step, by the cubic (step_curve.h) of its depth, which is positive
// while it touches. Before and after its extremum the depth is monotone, and so a step has three
// parts at most: a contact that begins and ends within one step is seen, and so is one that is lost
// and regained.

typedef struct {
  StepCurve depth;
  mask changes;                       // the rest is known where this holds in some lane
  mask on_before, on_turn, on_after;  // touching at the start, at the extremum and at the end
  mask in_first, in_second;           // the sign changes before the extremum, after it
  real first, turn, second;           // where; without an extremum `turn` is the end
} ContactTouch;

// The root of the depth between t = from and t = to, where its signs differ, and between which it
// is monotone: bisection, then Newton's method, which does not leave the bracket.
SHARED_FN real contact_root(const StepCurve* depth, real from, real to, mask is_on) {
  const real zero = 0;
  const real one_half = (scalar)(0.5);
  real low = from;
  real high = to;
  for (int i = 0; i < 3; ++i) {
    const real middle = one_half * (low + high);
    const mask before = (step_curve_at(depth, middle) > zero) == is_on;
    low = lane_select(before, middle, low);
    high = lane_select(before, high, middle);
  }
  real t = one_half * (low + high);
  for (int i = 0; i < 3; ++i) {
    const real slope = step_curve_slope(depth, t);
    const real next = t - step_curve_at(depth, t) / slope;
    t = lane_select(slope != zero, lane_clamp(next, low, high), t);
  }
  return t;
}

// By the depth at the step's four moments. False where nothing changes in any lane. What a lane
// gets does not depend on the others: those without a change are to be left alone.
SHARED_FN bool contact_touch(real earlier, real before, real middle, real after, real cubic,
                             ContactTouch* touch) {
  const real zero = 0;
  const real one = 1;
  touch->depth = step_curve(earlier, before, middle, after, cubic);
  const StepCurve* depth = &touch->depth;
  touch->on_before = before > zero;
  touch->on_after = after > zero;
  // Where both ends lie on one side of the limit, the extremum may lie on the other: it is within
  // |a| + |b| + |c| of the middle.
  const mask turns = step_curve_turns(depth);
  const real reach = lane_abs(depth->a) + lane_abs(depth->b) + lane_abs(depth->c);
  touch->changes = (touch->on_before != touch->on_after) |
                   (turns & (touch->on_before == (depth->a > zero)) & (lane_abs(middle) < reach));
  if (all_lanes(!touch->changes)) return false;
  touch->turn = step_curve_turn(depth, turns);
  touch->on_turn =
      ((step_curve_at(depth, touch->turn) > zero) & turns) | (touch->on_after & !turns);
  touch->in_first = touch->on_turn != touch->on_before;
  touch->in_second = touch->on_turn != touch->on_after;
  touch->first = contact_root(depth, -one, touch->turn, touch->on_before);
  touch->second =
      all_lanes(!touch->in_second) ? one : contact_root(depth, touch->turn, one, touch->on_turn);
  return true;
}
