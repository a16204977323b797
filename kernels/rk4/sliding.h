// A motion that both sides of a jump push towards it slides along it (A. F. Filippov,
// Differential Equations with Discontinuous Righthand Sides, 1988). With the field f below the
// surface and g above it, the field there is f + share (g - f), where the share, between 0 and 1,
// keeps the level what it is. Along several surfaces the differences add up. A motion that rests on
// a surface where its state is reset keeps the rate of the level, 0, by multiples of what a reset
// by a small rate changes. What is kept is called held.

#ifdef MODEL_SURFACES

#ifndef MODEL_RESETS
#define MODEL_RESETS(surface) 0
#endif

typedef struct {
  real base[MODEL_STATE_COUNT];  // the field below all surfaces that it slides along
  // What being above one adds to that; 0 of those that it does not slide along.
  real turn[MODEL_SURFACES][MODEL_STATE_COUNT];
  // [j][k] What turn k adds to the rate of what surface j holds.
  real gain[MODEL_SURFACES][MODEL_SURFACES];
  real share[MODEL_SURFACES];
  // A jump that holds what a surface holds that the motion rests against: its share is `edge`.
  mask bound[MODEL_SURFACES];
  real edge[MODEL_SURFACES];
} Sliding;

SHARED_FN mask sliding_any(const ModelPoint* point) {
  mask any = point->sides.slides[0];
  UNROLL
  for (int k = 1; k < MODEL_SURFACES; ++k) any = any | point->sides.slides[k];
  return any;
}

// How near two gains of a pair of surfaces come that hold the same.
#define SLIDING_SAME ((scalar)(REAL_BITS == 64 ? 1e-9 : 1e-4))

// Dry friction of a mass that rests against a wall holds its speed, as the wall does: what each of
// them does cannot be told. The wall lets it go on one side alone, so friction is that of this
// side.
SHARED_FN void sliding_bind(const ModelPoint* point, Sliding* sliding) {
  const real zero = 0;
  const real one = 1;
  UNROLL
  for (int j = 0; j < MODEL_SURFACES; ++j) {
    sliding->bound[j] = zero != zero;
    sliding->edge[j] = 0;
    if (MODEL_RESETS(j)) continue;
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      if (!MODEL_RESETS(k)) continue;
      const real both = sliding->gain[j][j] * sliding->gain[k][k];
      const real across = sliding->gain[j][k] * sliding->gain[k][j];
      const mask is_same = point->sides.slides[j] & point->sides.slides[k] & (both != zero) &
                           (lane_abs(both - across) <= SLIDING_SAME * lane_abs(both));
      const mask lets_up = sliding->gain[j][k] * sliding->gain[k][k] < zero;
      sliding->edge[j] = lane_select(is_same & lets_up, one, sliding->edge[j]);
      sliding->bound[j] = sliding->bound[j] | is_same;
    }
  }
}

// Whether it is a number, and finite.
SHARED_FN mask sliding_is_finite(real value) { return value - value == value - value; }

// Solves gain v = v for what the motion slides along; v is 0 of the others, and of what is bound
// `edges` times its edge.
SHARED_FN void sliding_solve(const ModelPoint* point, const Sliding* sliding, scalar edges,
                             real* v) {
  const real zero = 0;
  const real one = 1;
  real gain[MODEL_SURFACES][MODEL_SURFACES];
  UNROLL
  for (int j = 0; j < MODEL_SURFACES; ++j) {
    const mask counts = point->sides.slides[j] & !sliding->bound[j];
    v[j] = lane_select(counts, v[j], edges * sliding->edge[j]);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      gain[j][k] = lane_select(counts, sliding->gain[j][k], j == k ? one : zero);
    }
  }
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    UNROLL
    for (int j = k + 1; j < MODEL_SURFACES; ++j) {
      const real factor = gain[j][k] / gain[k][k];
      UNROLL
      for (int i = k + 1; i < MODEL_SURFACES; ++i) {
        gain[j][i] = gain[j][i] - factor * gain[k][i];
      }
      v[j] = v[j] - factor * v[k];
    }
  }
  UNROLL
  for (int k = MODEL_SURFACES - 1; k >= 0; --k) {
    UNROLL
    for (int i = k + 1; i < MODEL_SURFACES; ++i) v[k] = v[k] - gain[k][i] * v[i];
    v[k] = v[k] / gain[k][k];
  }
}

// The point below all surfaces that it slides along.
SHARED_FN ModelPoint sliding_below(const ModelPoint* point) {
  const real one = 1;
  ModelPoint below = *point;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    const real side = point->sides.side[k];
    if (!MODEL_RESETS(k)) {
      below.sides.side[k] = lane_select(point->sides.slides[k], side - one, side);
    }
  }
  return below;
}

SHARED_FN void sliding_turn(const ModelPoint* point, const PhaseAt* phase, const real* x,
                            int surface, real* turn) {
#ifdef MODEL_HAS_RESETS
  model_reset_turn(point, phase, x, surface, turn);
#else
  (void)point, (void)phase, (void)x, (void)surface, (void)turn;
#endif
}

SHARED_FN void sliding_find(const ModelPoint* point, const PhaseAt* phase, const real* x,
                            Sliding* sliding) {
  const real zero = 0;
  const ModelPoint below = sliding_below(point);
  real rates[MODEL_SURFACES];
  model_rhs(&below, phase, x, sliding->base);
  model_held_rates(&below, phase, x, sliding->base, rates);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    ModelPoint above = below;
    real added[MODEL_SURFACES];
    real* turn = sliding->turn[k];
    if (MODEL_RESETS(k)) {
      sliding_turn(point, phase, x, k, turn);
    } else {
      above.sides.side[k] = point->sides.side[k];
      model_rhs(&above, phase, x, turn);
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) turn[i] = turn[i] - sliding->base[i];
    }
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      turn[i] = lane_select(point->sides.slides[k], turn[i], zero);
    }
    model_held_along(point, phase, x, turn, added);
    UNROLL
    for (int j = 0; j < MODEL_SURFACES; ++j) sliding->gain[j][k] = added[j];
    sliding->share[k] = -rates[k];
  }
  sliding_bind(point, sliding);
  sliding_solve(point, sliding, 1, sliding->share);
  // Where no turn changes what is held, as where both sides have the same field, nothing holds the
  // motion there: it leaves to where both sides lead.
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    const real outside = lane_select(zero <= rates[k], (real)(2), (real)(-1));
    const real share = sliding->share[k];
    sliding->share[k] =
        lane_select(sliding_is_finite(share), share, MODEL_RESETS(k) ? (real)(-1) : outside);
  }
}

// Where no turn changes what is held, there is none of it.
SHARED_FN void sliding_keep_finite(real* multiples) {
  const real zero = 0;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    multiples[k] = lane_select(sliding_is_finite(multiples[k]), multiples[k], zero);
  }
}

// Adds multiples of the turns.
SHARED_FN void sliding_add(const Sliding* sliding, const real* multiples, real* x) {
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      x[i] = x[i] + multiples[k] * sliding->turn[k][i];
    }
  }
}

// Where the motion slides, the field there instead of dx.
SHARED_FN void sliding_slope(const ModelPoint* point, const PhaseAt* phase, const real* x,
                             real* dx) {
  const mask slides = sliding_any(point);
  if (all_lanes(!slides)) return;
  Sliding sliding;
  sliding_find(point, phase, x, &sliding);
  sliding_add(&sliding, sliding.share, sliding.base);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) dx[i] = lane_select(slides, sliding.base[i], dx[i]);
}

// out = J w with the Jacobian J of the field that slides; dx: that field.
SHARED_FN void sliding_tangent(const ModelPoint* point, const PhaseAt* phase, const real* x,
                               const Sliding* sliding, const real* dx, const real* w, real* out) {
  const real one = 1;
  const ModelPoint below = sliding_below(point);
  ModelLinear linear;
  real zeros[MODEL_STATE_COUNT];
  real of_base[MODEL_STATE_COUNT];
  real shift[MODEL_SURFACES];
  real bends[MODEL_SURFACES];
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) zeros[i] = 0;
  model_linearize(&below, phase, x, one, &linear);
  model_tangent(&below, &linear, w, zeros, of_base);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) out[i] = of_base[i];
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (MODEL_RESETS(k)) continue;
    ModelPoint above = below;
    real of_above[MODEL_STATE_COUNT];
    above.sides.side[k] = point->sides.side[k];
    model_linearize(&above, phase, x, one, &linear);
    model_tangent(&above, &linear, w, zeros, of_above);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      out[i] = out[i] + sliding->share[k] * (of_above[i] - of_base[i]);
    }
  }
  // The share changes, too, so that what is held stays what it is.
  model_held_along(point, phase, x, out, shift);
  model_held_bends(point, phase, x, dx, w, bends);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) shift[k] = -(shift[k] + bends[k]);
  sliding_solve(point, sliding, 0, shift);
  sliding_keep_finite(shift);
  sliding_add(sliding, shift, out);
}

#endif
