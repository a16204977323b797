// Surfaces where the state is reset, and what stays at a surface. Impacts that follow each other
// ever faster end in contact: once a flight takes less than a thousandth of a step, or is lower
// than rounding, the motion rests on the surface while it is pushed against it. In a step that has
// been cut 64 times (SURFACE_MANY_CUTS), as where a ball of r = 0.99 nears its rest, a flight of a
// fiftieth is as short.

#include "rk4/surface_events.h"

#ifdef MODEL_SURFACES

#define SURFACE_SHORT_FLIGHT ((scalar)(1e-3))  // of a step
#define SURFACE_SHORT_OF_MANY ((scalar)(2e-2))
#define SURFACE_MANY_CUTS ((scalar)(64))
#define SURFACE_ROUNDING ((scalar)(REAL_BITS == 64 ? 1.8e-15 : 9.6e-7))  // 8 roundings

// The change of the state that takes a surface's level up by 1; and what rounding may leave of the
// level.
SHARED_FN real surface_normal(const ModelPoint* point, const PhaseAt* moment, const real* x,
                              int surface, real* normal) {
  real squares = 0;
  real terms = 0;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    real unit[MODEL_STATE_COUNT];
    real rates[MODEL_SURFACES];
    UNROLL
    for (int j = 0; j < MODEL_STATE_COUNT; ++j) unit[j] = i == j ? 1 : 0;
    model_level_along(point, moment, x, unit, rates);
    normal[i] = rates[surface];
    squares = squares + normal[i] * normal[i];
    terms = terms + lane_abs(normal[i] * x[i]);
  }
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) normal[i] = normal[i] / squares;
  return SURFACE_ROUNDING * terms;
}

// What rounding may leave of the rate of a surface's level.
SHARED_FN real surface_rate_rounding(const ModelPoint* point, const PhaseAt* moment, const real* x,
                                     int surface, const real* field) {
  real normal[MODEL_STATE_COUNT];
  real squares = 0;
  real terms = 0;
  (void)surface_normal(point, moment, x, surface, normal);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    squares = squares + normal[i] * normal[i];
    terms = terms + lane_abs(normal[i] * field[i]);
  }
  return SURFACE_ROUNDING * (terms / squares);
}

// Takes lanes to just above or below a surface, at a level of `at`, so that by rounding none counts
// as on the other side. Returns what rounding may leave of the level.
SHARED_FN real surface_put_beside(const ModelPoint* point, const PhaseAt* moment, int surface,
                                  real at, mask above, mask where, real* x) {
  real normal[MODEL_STATE_COUNT];
  real levels[MODEL_SURFACES];
  model_level_values(point, moment, x, levels);
  const real rounding = surface_normal(point, moment, x, surface, normal);
  const real down = (levels[surface] - at) + lane_select(above, -rounding, rounding);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    x[i] = lane_select(where, x[i] - down * normal[i], x[i]);
  }
  return rounding;
}

SHARED_FN real surface_put_below(const ModelPoint* point, const PhaseAt* moment, int surface,
                                 mask where, real* x) {
  const real zero = 0;
  return surface_put_beside(point, moment, surface, zero, zero != zero, where, x);
}

#ifdef MODEL_HAS_RESETS
// Takes lanes to just below all surfaces that they rest against, at once: one after the other, each
// would lift the state above the one before, where both move a mass between them.
SHARED_FN void surface_put_below_all(const ModelPoint* point, const PhaseAt* moment, mask where,
                                     real* x) {
  real normal[MODEL_SURFACES][MODEL_STATE_COUNT];
  real down[MODEL_SURFACES];
  ModelPoint resting = *point;
  Sliding sliding;
  model_level_values(point, moment, x, down);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    resting.sides.slides[k] = where & point->sides.slides[k];
    if (!MODEL_RESETS(k)) resting.sides.slides[k] = where & !where;
    sliding.bound[k] = where & !where;
    sliding.edge[k] = 0;
    down[k] = down[k] + surface_normal(point, moment, x, k, normal[k]);
  }
  UNROLL
  for (int j = 0; j < MODEL_SURFACES; ++j) {
    real squares = 0;
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) squares = squares + normal[j][i] * normal[j][i];
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      real both = 0;
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) both = both + normal[j][i] * normal[k][i];
      sliding.gain[j][k] = both / squares;
    }
  }
  sliding_solve(&resting, &sliding, 0, down);
  sliding_keep_finite(down);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (!MODEL_RESETS(k)) continue;
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      x[i] = lane_select(resting.sides.slides[k], x[i] - down[k] * normal[k][i], x[i]);
    }
  }
}
#else
SHARED_FN void surface_put_below_all(const ModelPoint* point, const PhaseAt* moment, mask where,
                                     real* x) {
  (void)point, (void)moment, (void)where, (void)x;
}
#endif

// Takes a motion that slides back onto its surfaces: a step leaves them by what it is wrong by. A
// state that the way back leaves nothing of but rounding of what a step of length h adds to it is
// 0, so that what sticks is at rest.
SHARED_FN void surface_return(const ModelPoint* point, const PhaseAt* moment, real h, mask where,
                              real* x) {
  const real zero = 0;
  const mask slides = where & sliding_any(point);
  if (all_lanes(!slides)) return;
  Sliding sliding;
  real levels[MODEL_SURFACES];
  real back[MODEL_STATE_COUNT];
  surface_put_below_all(point, moment, where, x);
  sliding_find(point, moment, x, &sliding);
  model_held_values(point, moment, x, levels);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    levels[k] = surface_level(k, point->sides.side[k]) - levels[k];
  }
  sliding_solve(point, &sliding, 0, levels);
  sliding_keep_finite(levels);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) back[i] = x[i];
  sliding_add(&sliding, levels, back);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    real added = lane_abs(sliding.base[i]);
    mask is_held = zero != zero;
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      is_held = is_held | (sliding.turn[k][i] != zero);
      if (!MODEL_RESETS(k)) added = added + lane_abs(sliding.turn[k][i]);
    }
    const mask is_rounding = is_held & (lane_abs(back[i]) <= SURFACE_ROUNDING * h * added);
    x[i] = lane_select(slides, lane_select(is_rounding, zero, back[i]), x[i]);
  }
}

// Where a motion rests, the jumps that hold the same (sliding_bind) and that it is at.
SHARED_FN void surface_bind(ModelPoint* point, const PhaseAt* moment, real h, mask where,
                            const real* x) {
  const real one = 1;
  real levels[MODEL_SURFACES];
  model_level_values(point, moment, x, levels);
  UNROLL
  for (int j = 0; j < MODEL_SURFACES; ++j) {
    if (MODEL_RESETS(j)) continue;
    const real above = MODEL_STAIRCASE(j) ? lane_rint(levels[j]) : one;
    ModelPoint held = *point;
    Sliding sliding;
    held.sides.side[j] = above;
    held.sides.slides[j] = where;
    sliding_find(&held, moment, x, &sliding);
    const real reach = SURFACE_NEAR * h * lane_abs(sliding.gain[j][j]);
    const mask binds =
        where & sliding.bound[j] & (lane_abs(levels[j] - surface_level(j, above)) <= reach);
    point->sides.side[j] = lane_select(binds, above, point->sides.side[j]);
    point->sides.slides[j] = point->sides.slides[j] | binds;
  }
}

// In lanes that rest against a surface where the state is reset.
SHARED_FN void surface_bind_resting(ModelPoint* point, const PhaseAt* moment, real h,
                                    const real* x) {
  const real zero = 0;
  mask rests = zero != zero;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (MODEL_RESETS(k)) rests = rests | point->sides.slides[k];
  }
  if (!all_lanes(!rests)) surface_bind(point, moment, h, rests, x);
}

#ifdef MODEL_HAS_RESETS
// Resets the state in these lanes, and carries the field and the tangent vectors by the reset's
// derivative.
SHARED_FN void surface_reset(const ModelPoint* point, const PhaseAt* moment, int surface,
                             mask where, int beside, real* x, real* field, real* w) {
  real from[MODEL_STATE_COUNT];
  real out[MODEL_STATE_COUNT];
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) from[i] = x[i];
  model_reset(point, moment, from, surface, out);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = lane_select(where, out[i], x[i]);
  model_reset_rates(point, moment, from, surface, field, out);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) field[i] = lane_select(where, out[i], field[i]);
#if TANGENTS > 0
  for (int j = 0; j < TANGENTS && beside & RK4_LINEAR; ++j) {
    real* own = w + j * MODEL_STATE_COUNT;
    model_reset_along(point, moment, from, surface, own, out);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) own[i] = lane_select(where, out[i], own[i]);
  }
#else
  (void)beside, (void)w;
#endif
}

// Resets the state at the surfaces that are met. Where that puts it to another side of others, it
// is there at once; where it lifts it above one that resets it, too, or drives it into one that it
// rests against, that one is met at the same moment: one after the other, each once. From one that
// it rests against it may also be thrown off.
SHARED_FN void surface_resets(ModelPoint* point, const PhaseAt* moment, real h, int beside, real* x,
                              real* field, real* w, SurfaceMet* met) {
  const real zero = 0;
  const real one = 1;
  mask now[MODEL_SURFACES];
  mask rested[MODEL_SURFACES];
  mask changed[MODEL_SURFACES];  // by a reset: the level, or what rest keeps
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    now[k] = met->hit[k];
    rested[k] = MODEL_RESETS(k) ? point->sides.slides[k] & !met->hit[k] : zero != zero;
    changed[k] = zero != zero;
  }
  for (int times = 0; times < MODEL_SURFACES; ++times) {
    real before[MODEL_SURFACES];
    real after[MODEL_SURFACES];
    real held_before[MODEL_SURFACES];
    real held_after[MODEL_SURFACES];
    real dx[MODEL_STATE_COUNT];
    real rates[MODEL_SURFACES];
    mask moved[MODEL_SURFACES];
    mask due[MODEL_SURFACES];
    mask any = now[0];
    UNROLL
    for (int k = 1; k < MODEL_SURFACES; ++k) any = any | now[k];
    if (all_lanes(!any)) break;
    model_level_values(point, moment, x, before);
    model_held_values(point, moment, x, held_before);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      if (!MODEL_RESETS(k) || all_lanes(!now[k])) continue;
      surface_reset(point, moment, k, now[k], beside, x, field, w);
    }
    model_level_values(point, moment, x, after);
    model_held_values(point, moment, x, held_after);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      met->behind[k] = lane_select(now[k], held_after[k], met->behind[k]);
      met->in_place[k] = (met->in_place[k] | now[k]) & (!any | (after[k] == before[k]));
      moved[k] = any & !met->hit[k] &
                 ((after[k] != before[k]) | (rested[k] & (held_after[k] != held_before[k])));
      changed[k] = changed[k] | moved[k];
      const mask is_lifted = changed[k] & (point->sides.side[k] < one) & (zero < after[k]);
      due[k] = MODEL_RESETS(k) ? is_lifted : zero != zero;
      moved[k] = moved[k] & !due[k];
    }
    surfaces_find_sides(point, moment, h, x, after, moved);
    mask is_free = any;  // no other surface is met next
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      const mask is_still_at = moved[k] & rested[k] & (after[k] == before[k]);
      point->sides.side[k] = lane_select(is_still_at, zero, point->sides.side[k]);
      const mask is_struck =
          changed[k] & rested[k] & !point->sides.slides[k] & (zero < held_after[k]);
      now[k] = (due[k] | is_struck) & !met->hit[k] & is_free;
      is_free = is_free & !now[k];
    }
    surface_bind_resting(point, moment, h, x);
    surface_field(point, moment, x, dx, rates);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      if (!MODEL_RESETS(k)) continue;
      met->hit[k] = met->hit[k] | now[k];
      met->rate[k] = lane_select(now[k], lane_max(rates[k], zero), met->rate[k]);
      point->sides.slides[k] = point->sides.slides[k] & !now[k];
    }
  }
}

// Behind a reset: back, on through the surface, to where the reset put it, or at rest on it, where
// the flight to the next impact would be too short to count. What rests may push others into rest:
// one round after the other, until no more come to it. cuts: of the step, so far.
SHARED_FN void surface_rebound(ModelPoint* point, const PhaseAt* moment, real h, real cuts,
                               const mask* hit, const mask* touched, const SurfaceMet* met,
                               const real* levels_before, real* x) {
  const real zero = 0;
  const real one = 1;
  const real shortest = lane_select(cuts < SURFACE_MANY_CUTS, (real)(SURFACE_SHORT_FLIGHT),
                                    (real)(SURFACE_SHORT_OF_MANY));
  for (int times = 0; times < MODEL_SURFACES; ++times) {
    real field[MODEL_STATE_COUNT];
    real rates[MODEL_SURFACES];
    real levels[MODEL_SURFACES];
    real pushes[MODEL_SURFACES];
    mask rests = zero != zero;
    surface_field(point, moment, x, field, rates);
    model_level_values(point, moment, x, levels);
    model_held_rates(point, moment, x, field, pushes);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      if (!MODEL_RESETS(k)) continue;
      const mask is_new = !point->sides.slides[k];
      const mask is_reset = met->hit[k] & is_new;
      const real rate = rates[k];
      const real push = pushes[k];
      // The reset leaves the level what it was, but for rounding; where the motion came to it.
      real normal[MODEL_STATE_COUNT];
      const real came_to = lane_select(hit[k], lane_abs(levels_before[k]), zero);
      const real reach = came_to + surface_normal(point, moment, x, k, normal) +
                         SURFACE_NEAR * h * lane_max(lane_abs(rate), h * push);
      const mask is_at = met->in_place[k] | (lane_abs(levels[k]) <= (scalar)(2) * reach);
      // Where a reset leaves no speed the rate is rounding.
      const real smallest =
          SURFACE_NEAR * met->rate[k] + surface_rate_rounding(point, moment, x, k, field);
      // Thrown back, and driven against it again by another surface, it is met anew.
      const mask goes_on = (smallest < rate) & (smallest < met->behind[k]);
      const mask is_above = (is_at & goes_on) | (!is_at & (zero < levels[k]));
      // What only touches it from below goes on there.
      const mask touches = touched[k] & is_new;
      const mask returns = touches | (is_reset & !is_above);
      const real rounding = surface_put_below(point, moment, k, touches | (returns & is_at), x);
      // A flight that is too short, or too low.
      const mask is_short = (scalar)(2) * lane_abs(rate) <= shortest * h * push;
      const mask is_low = rate * rate <= (scalar)(8) * push * rounding;
      const mask stays =
          (touches | (is_reset & is_at & !goes_on)) & (zero < push) & (is_short | is_low);
      point->sides.side[k] =
          lane_select(returns, zero, lane_select(is_reset, one, point->sides.side[k]));
      point->sides.slides[k] = point->sides.slides[k] | stays;
      rests = rests | stays;
    }
    if (all_lanes(!rests)) return;
    point->sides.slid = point->sides.slid | rests;
    surface_return(point, moment, h, rests, x);
    surface_bind(point, moment, h, rests, x);
  }
}

#else
SHARED_FN void surface_resets(ModelPoint* point, const PhaseAt* moment, real h, int beside, real* x,
                              real* field, real* w, SurfaceMet* met) {
  (void)point, (void)moment, (void)h, (void)beside, (void)x, (void)field, (void)w, (void)met;
}
SHARED_FN void surface_rebound(ModelPoint* point, const PhaseAt* moment, real h, real cuts,
                               const mask* hit, const mask* touched, const SurfaceMet* met,
                               const real* levels_before, real* x) {
  (void)point, (void)moment, (void)h, (void)cuts, (void)hit, (void)touched, (void)met;
  (void)levels_before, (void)x;
}
#endif

#endif
