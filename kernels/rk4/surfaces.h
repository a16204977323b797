// Steps of a model whose equations jump with a state (MODEL_SURFACES). A step is taken on the side
// of each surface that the motion is on. Where it ends on another side, it is taken anew up to the
// crossing, which the cubic of the level through both ends tells and Newton's method on the way
// itself then makes exact, and the rest is taken on the other side. Each lane does that by itself:
// those that have nothing to cross are done after the first pass.
//
// A tangent vector w that is carried through a crossing jumps by (g - f) (grad(level) w)/rate, with
// the fields f before it and g behind it, and the rate of the level before it (the saltation
// matrix; R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical Systems,
// 2004, chapter 7). Where a motion begins to slide, what w has across the surface is lost.

#include "rk4/surface_part.h"

#ifdef MODEL_SURFACES

// Where a state is reset, the vector is carried by the reset's derivative as well. Impacts that
// follow each other ever faster end in contact: once a flight takes less than a thousandth of a
// step, the motion rests on the surface while it is pushed against it.

// Each crossing takes two. What is left after so many is taken on the side that is held.
#ifdef MODEL_HAS_RESETS
#define SURFACE_PASSES 256
#else
#define SURFACE_PASSES 32
#endif
#define SURFACE_SHORT_FLIGHT ((scalar)(1e-3))  // of a step
// Of the distance that a level goes in a step: nearer than that to a surface a motion is on it.
#define SURFACE_NEAR ((scalar)(REAL_BITS == 64 ? 1e-9 : 1e-4))
// The same where the state is reset: a motion that has just met it must not count as beyond it.
#define SURFACE_ON ((scalar)(REAL_BITS == 64 ? 1e-6 : 1e-3))
#define SURFACE_ROUNDING ((scalar)(REAL_BITS == 64 ? 1.8e-15 : 9.6e-7))  // 8 roundings

// What ends a step, or a part of it.
typedef struct {
  mask any;
  real after;  // share of the part at which it lies
  // Of each surface: whether it is this one that is crossed, or that the motion leaves, along which
  // it slid; and the side on which it goes on.
  mask crossed[MODEL_SURFACES], left[MODEL_SURFACES];
  real side[MODEL_SURFACES];
} SurfaceEvent;

// The level at which a surface lies between two sides, of which this is the one above.
SHARED_FN real surface_level(int surface, real above) {
  const real zero = 0;
  return MODEL_STAIRCASE(surface) ? above : zero;
}

// The field, and the rates of the levels along it.
SHARED_FN void surface_field(const ModelPoint* point, const PhaseAt* moment, const real* x,
                             real* dx, real* rates) {
  ContactSeen seen;
  rk4_slope(point, moment, x, &seen, dx);
  model_level_rates(point, moment, x, dx, rates);
}

// On a surface where the state is reset, a motion that is pushed against it rests.
SHARED_FN void surface_begin_rest(ModelPoint* point, const PhaseAt* moment, real h, const real* x,
                                  int surface, real level) {
  const real zero = 0;
  real dx[MODEL_STATE_COUNT];
  real rates[MODEL_SURFACES];
  real pushes[MODEL_SURFACES];
  surface_field(point, moment, x, dx, rates);
  model_held_rates(point, moment, x, dx, pushes);
  const real rate = lane_abs(rates[surface]);
  const real push = pushes[surface];
  const mask near = lane_abs(level) <= SURFACE_ON * h * lane_max(rate, h * lane_abs(push));
  point->sides.side[surface] = lane_select(near, zero, point->sides.side[surface]);
  point->sides.slides[surface] = near & (zero < push) & (rate <= SURFACE_NEAR * h * push);
}

// The sides at a state where nothing is known of the way there. On a surface the fields of both
// sides decide: where both lead to one side, that one; where both push towards it, the motion
// slides; where both lead away, it goes on above.
SHARED_FN void surfaces_begin(ModelPoint* point, const SurfaceRows* rows, const real* x) {
  const real zero = 0;
  const real one = 1;
  PhaseAt moment;
  real levels[MODEL_SURFACES];
  surface_moment(rows, zero, &moment);
  model_level_values(point, &moment, x, levels);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    const real whole = lane_floor(levels[k]);
    const real upper = lane_select(zero < levels[k], one, zero);
    point->sides.side[k] = MODEL_STAIRCASE(k) ? whole : upper;
    point->sides.slides[k] = zero != zero;
  }
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (MODEL_RESETS(k)) {
      surface_begin_rest(point, &moment, rows->h, x, k, levels[k]);
      continue;
    }
    const real above_side = MODEL_STAIRCASE(k) ? lane_rint(levels[k]) : one;
    ModelPoint above = *point;
    ModelPoint below = *point;
    real dx[MODEL_STATE_COUNT];
    real rates_above[MODEL_SURFACES];
    real rates_below[MODEL_SURFACES];
    above.sides.side[k] = above_side;
    below.sides.side[k] = above_side - one;
    surface_field(&above, &moment, x, dx, rates_above);
    surface_field(&below, &moment, x, dx, rates_below);
    const real up = rates_above[k];
    const real down = rates_below[k];
    const real reach = SURFACE_NEAR * rows->h * lane_max(lane_abs(up), lane_abs(down));
    const mask near = lane_abs(levels[k] - surface_level(k, above_side)) <= reach;
    const mask slides = near & (up < zero) & (zero < down);
    const mask falls = near & (up < zero) & !slides;
    const mask rises = near & !(up < zero);
    const real side = lane_select(falls, above_side - one, point->sides.side[k]);
    point->sides.side[k] = lane_select(slides | rises, above_side, side);
    point->sides.slides[k] = slides;
  }
  point->sides.slid = point->sides.slid | sliding_any(point);
}

// The cubic of a level over a part of a step: its values and slopes at both ends.
typedef struct {
  real value, slope, square, cube;
} SurfaceCurve;

SHARED_FN real surface_curve_at(const SurfaceCurve* curve, real t) {
  return curve->value + t * (curve->slope + t * (curve->square + t * curve->cube));
}

// Where a level first goes above `up` or below `down`; false where it does not. l, r: the level
// and its slope at the part's start and end.
SHARED_FN mask surface_cross(real l0, real l1, real r0, real r1, real up, real down, real* after,
                             mask* is_up) {
  const real zero = 0;
  const real one = 1;
  const real two = 2;
  const real three = 3;
  const real change = l1 - l0;
  const SurfaceCurve curve = {l0, r0, three * change - two * r0 - r1, r0 + r1 - two * change};
  // A turn inside the part counts from a distance that rounding does not make.
  const real told = SURFACE_NEAR * (lane_abs(change) + lane_abs(r0) + lane_abs(r1));
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
  const real at_first = surface_curve_at(&curve, first);
  const real at_second = surface_curve_at(&curve, second);
  const mask first_up = up + told < at_first;
  const mask first_hit = first_up | (at_first < down - told);
  const mask second_up = up + told < at_second;
  const mask second_hit = second_up | (at_second < down - told);
  const mask end_up = up < l1;
  const mask end_hit = end_up | (l1 < down);
  const mask hit = first_hit | second_hit | end_hit;
  *after = one;
  *is_up = (first_hit & first_up) | (!first_hit & second_hit & second_up) |
           (!first_hit & !second_hit & end_up);
  if (all_lanes(!hit)) return hit;
  real low = lane_select(first_hit, zero, lane_select(second_hit, first, second));
  real high = lane_select(first_hit, first, lane_select(second_hit, second, one));
  const real limit = lane_select(*is_up, up, down);
  const mask rises = *is_up;
  for (int i = 0; i < 8; ++i) {
    const real middle = (scalar)(0.5) * (low + high);
    const real value = surface_curve_at(&curve, middle);
    const mask is_beyond = (rises & (limit < value)) | (!rises & (value < limit));
    high = lane_select(is_beyond, middle, high);
    low = lane_select(is_beyond, low, middle);
  }
  real t = (scalar)(0.5) * (low + high);
  for (int i = 0; i < 3; ++i) {
    const real slope = curve.slope + t * (two * curve.square + three * curve.cube * t);
    const real next = t - (surface_curve_at(&curve, t) - limit) / slope;
    t = lane_select(slope != zero, lane_clamp(next, low, high), t);
  }
  *after = lane_select(hit, t, one);
  return hit;
}

SHARED_FN void surface_take(SurfaceEvent* event, mask is_earlier, real after, int surface,
                            mask is_crossed, real side) {
  const mask none = event->any & !event->any;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    event->crossed[k] =
        lane_select(is_earlier, k == surface ? is_crossed : none, event->crossed[k]);
    event->left[k] = lane_select(is_earlier, k == surface ? !is_crossed : none, event->left[k]);
  }
  event->side[surface] = lane_select(is_earlier, side, event->side[surface]);
  event->after = lane_select(is_earlier, after, event->after);
  event->any = event->any | is_earlier;
}

// Where the share of a surface that the motion slides along leaves [0, 1].
SHARED_FN void surface_find_leaving(const ModelPoint* point, const SurfacePart* part,
                                    SurfaceEvent* event) {
  const real zero = 0;
  const real one = 1;
  Sliding first;
  Sliding last;
  sliding_find(point, part->start, part->x, &first);
  sliding_find(point, part->end, part->next, &last);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    // How far the share is inside; the bound is that which it passes at the end, or is beyond at
    // the start.
    const real most = MODEL_RESETS(k) ? (real)(INFINITY) : one;
    const mask starts_out =
        (first.share[k] < -SURFACE_NEAR) | (most + SURFACE_NEAR < first.share[k]);
    const real deciding = lane_select(starts_out, first.share[k], last.share[k]);
    const mask is_above = most < deciding;
    const mask leaves =
        point->sides.slides[k] & (starts_out | (last.share[k] < zero) | (most < last.share[k]));
    if (all_lanes(!leaves)) continue;
    const real bound = lane_select(is_above, one, zero);
    const real way = lane_select(is_above, -one, one);
    real low = 0;
    real high = 1;
    real at_low = way * (first.share[k] - bound);
    real at_high = way * (last.share[k] - bound);
    real t = 0;
    for (int i = 0; i < 12; ++i) {
      PhaseAt moment;
      Sliding sliding;
      real x[MODEL_STATE_COUNT];
      t = lane_select(at_low != at_high, low + (high - low) * (at_low / (at_low - at_high)), low);
      t = lane_clamp(t, low, high);
      surface_moment(part->rows, part->from + t * (one - part->from), &moment);
      surface_inside(part, t, x);
      sliding_find(point, &moment, x, &sliding);
      const real inside = way * (sliding.share[k] - bound);
      const mask is_in = zero < inside;
      // The end that stays counts one_half from now on (the Illinois method).
      at_high = lane_select(is_in, (scalar)(0.5) * at_high, inside);
      at_low = lane_select(is_in, inside, (scalar)(0.5) * at_low);
      low = lane_select(is_in, t, low);
      high = lane_select(is_in, high, t);
    }
    // Where it is outside for sure.
    t = lane_select(starts_out, zero, high);
    const real side = point->sides.side[k];
    surface_take(event, leaves & (t < event->after), t, k, leaves & !leaves,
                 MODEL_RESETS(k) ? side : lane_select(is_above, side, side - one));
  }
}

// The first event of a part.
SHARED_FN void surface_find(const ModelPoint* point, const SurfacePart* part, const mask* has_left,
                            SurfaceEvent* event) {
  const real zero = 0;
  const real one = 1;
  const real unbounded = (real)(INFINITY);
  real l0[MODEL_SURFACES];
  real l1[MODEL_SURFACES];
  real r0[MODEL_SURFACES];
  real r1[MODEL_SURFACES];
  model_level_values(point, part->start, part->x, l0);
  model_level_values(point, part->end, part->next, l1);
  model_level_rates(point, part->start, part->x, part->slopes->first, r0);
  model_level_rates(point, part->end, part->next, part->slopes->last, r1);
  event->any = zero != zero;
  event->after = (scalar)(2);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    const real side = point->sides.side[k];
    const real up = MODEL_STAIRCASE(k) ? side + one : lane_select(side < one, zero, unbounded);
    const real down = MODEL_STAIRCASE(k) ? side : lane_select(zero < side, zero, -unbounded);
    real after;
    mask is_up;
    event->crossed[k] = event->left[k] = zero != zero;
    event->side[k] = side;
    const mask hit = surface_cross(l0[k], l1[k], part->length * r0[k], part->length * r1[k], up,
                                   down, &after, &is_up);
    surface_take(event, hit & !point->sides.slides[k] & !has_left[k] & (after < event->after),
                 after, k, hit, lane_select(is_up, side + one, side - one));
  }
  if (!all_lanes(!sliding_any(point))) surface_find_leaving(point, part, event);
}

#if TANGENTS > 0
// The tangent vectors of lanes that slide, over a part.
SHARED_FN void surface_sliding_tangents(const ModelPoint* point, const SurfacePart* part,
                                        mask where, real* w) {
  real at[MODEL_STATE_COUNT];
  real at_w[TANGENT_NUMBERS];
  real sum_w[TANGENT_NUMBERS];
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) at[i] = part->x[i];
  for (int i = 0; i < TANGENT_NUMBERS; ++i) at_w[i] = sum_w[i] = w[i];
  for (int stage = 0; stage < RK4_EVALUATIONS; ++stage) {
    const bool is_outer = stage == 0 || stage == 3;
    const PhaseAt moment = stage == 0 ? *part->start : stage == 3 ? *part->end : *part->middle;
    const real weight = part->length * (scalar)(is_outer ? 1.0 / 6.0 : 1.0 / 3.0);
    const real reach = part->length * (scalar)(stage == 2 ? 1.0 : 0.5);
    Sliding sliding;
    real dx[MODEL_STATE_COUNT];
    sliding_find(point, &moment, at, &sliding);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) dx[i] = sliding.base[i];
    sliding_add(&sliding, sliding.share, dx);
    for (int j = 0; j < TANGENTS; ++j) {
      const int first = j * MODEL_STATE_COUNT;
      real out[MODEL_STATE_COUNT];
      sliding_tangent(point, &moment, at, &sliding, dx, at_w + first, out);
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
        sum_w[first + i] = sum_w[first + i] + weight * out[i];
        at_w[first + i] = w[first + i] + reach * out[i];
      }
    }
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) at[i] = part->x[i] + reach * dx[i];
  }
  for (int i = 0; i < TANGENT_NUMBERS; ++i) w[i] = lane_select(where, sum_w[i], w[i]);
}

// Advances the tangent vectors of these lanes over a part.
SHARED_FN void surface_tangents(const ModelPoint* point, const SurfacePart* part, int beside,
                                const ModelLinear* linear, const Crossings* crossings, mask where,
                                real* w) {
  const mask slides = where & sliding_any(point);
  for (int j = 0; j < TANGENTS; ++j) {
    real row[MODEL_STATE_COUNT];
    real* own = w + j * MODEL_STATE_COUNT;
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) row[i] = own[i];
    rk4_tangent_step(point, part->length, beside, linear, crossings, row);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      own[i] = lane_select(where & !slides, row[i], own[i]);
    }
  }
  if (!all_lanes(!slides)) surface_sliding_tangents(point, part, slides, w);
}

// How much earlier each tangent vector comes to the surface that is crossed.
SHARED_FN void surface_delays(const ModelPoint* point, const PhaseAt* moment, const real* x,
                              const real* rates, const mask* hit, const real* w, real* delays) {
  const real zero = 0;
  for (int j = 0; j < TANGENTS; ++j) {
    real added[MODEL_SURFACES];
    real delay = 0;
    model_level_along(point, moment, x, w + j * MODEL_STATE_COUNT, added);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      delay = lane_select(hit[k] & (rates[k] != zero), added[k] / rates[k], delay);
    }
    delays[j] = delay;
  }
}
#endif

// How much later the motion is on a surface. A flight between impacts has two ends: of the parabola
// through both, the later one.
SHARED_FN real surface_delay(const ModelPoint* point, const PhaseAt* moment, const real* x,
                             const real* dx, int surface, real level, real rate) {
  const real zero = 0;
  const real two = 2;
  real later = -level / rate;
#ifdef MODEL_HAS_RESETS
  if (MODEL_RESETS(surface)) {
    real pushes[MODEL_SURFACES];
    model_held_rates(point, moment, x, dx, pushes);
    const real push = pushes[surface];
    const real root = lane_sqrt(lane_max(rate * rate - two * push * level, zero));
    const real behind = -two * level / (rate + root);
    const real ahead = (root - rate) / push;
    later = lane_select(zero < push, lane_select(zero < rate, behind, ahead), later);
  }
#else
  (void)point, (void)moment, (void)x, (void)dx, (void)surface, (void)zero, (void)two;
#endif
  return later;
}

// Takes lanes that have come to a surface, at a share of the step, onto it by Newton's method.
SHARED_FN void surface_land(const ModelPoint* point, const SurfaceRows* rows,
                            const SurfaceEvent* event, mask where, real* share, real* x) {
  const real zero = 0;
  const real longest = (scalar)(0.01) * rows->h;
  for (int i = 0; i < 3; ++i) {
    PhaseAt moment;
    real dx[MODEL_STATE_COUNT];
    real rates[MODEL_SURFACES];
    real levels[MODEL_SURFACES];
    real delay = 0;
    surface_moment(rows, *share, &moment);
    surface_field(point, &moment, x, dx, rates);
    model_level_values(point, &moment, x, levels);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      const real level =
          surface_level(k, lane_max(point->sides.side[k], event->side[k])) - levels[k];
      const mask counts = where & event->crossed[k] & (rates[k] != zero);
      const real later = surface_delay(point, &moment, x, dx, k, -level, rates[k]);
      delay = lane_select(counts, lane_clamp(later, -longest, longest), delay);
    }
    UNROLL
    for (int j = 0; j < MODEL_STATE_COUNT; ++j) x[j] = x[j] + delay * dx[j];
    *share = *share + delay / rows->h;
  }
}

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

// Takes lanes to just below a surface, so that by rounding none counts as beyond it. Returns what
// rounding may leave of the level.
SHARED_FN real surface_put_below(const ModelPoint* point, const PhaseAt* moment, int surface,
                                 mask where, real* x) {
  real normal[MODEL_STATE_COUNT];
  real levels[MODEL_SURFACES];
  model_level_values(point, moment, x, levels);
  const real rounding = surface_normal(point, moment, x, surface, normal);
  const real down = levels[surface] + rounding;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    x[i] = lane_select(where, x[i] - down * normal[i], x[i]);
  }
  return rounding;
}

// Takes a motion that slides back onto its surfaces: a step leaves them by what it is wrong by.
SHARED_FN void surface_return(const ModelPoint* point, const PhaseAt* moment, mask where, real* x) {
  const mask slides = where & sliding_any(point);
  if (all_lanes(!slides)) return;
  Sliding sliding;
  real levels[MODEL_SURFACES];
  real back[MODEL_STATE_COUNT];
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (!MODEL_RESETS(k)) continue;
    surface_put_below(point, moment, k, where & point->sides.slides[k], x);
  }
  sliding_find(point, moment, x, &sliding);
  model_held_values(point, moment, x, levels);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    levels[k] = surface_level(k, point->sides.side[k]) - levels[k];
  }
  sliding_solve(point, &sliding, levels);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) back[i] = x[i];
  sliding_add(&sliding, levels, back);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = lane_select(slides, back[i], x[i]);
}

#ifdef MODEL_HAS_RESETS
// Resets the state where a surface was met from below, and carries the field and the tangent
// vectors by the reset's derivative.
SHARED_FN void surface_reset(const ModelPoint* point, const PhaseAt* moment, const mask* hit,
                             const real* rates, int beside, real* x, real* field, real* w) {
  const real zero = 0;
  real from[MODEL_STATE_COUNT];
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) from[i] = x[i];
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (!MODEL_RESETS(k)) continue;
    const mask is_reset = hit[k] & (zero < rates[k]);
    if (all_lanes(!is_reset)) continue;
    real out[MODEL_STATE_COUNT];
    model_reset(point, moment, from, k, out);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = lane_select(is_reset, out[i], x[i]);
    model_reset_rates(point, moment, from, k, field, out);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) field[i] = lane_select(is_reset, out[i], field[i]);
#if TANGENTS > 0
    for (int j = 0; j < TANGENTS && beside & RK4_LINEAR; ++j) {
      real* own = w + j * MODEL_STATE_COUNT;
      model_reset_along(point, moment, from, k, own, out);
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) own[i] = lane_select(is_reset, out[i], own[i]);
    }
#else
    (void)beside, (void)w;
#endif
  }
}

// Behind a reset: back, on through the surface, to where the reset put it, or at rest on it, where
// the flight to the next impact would be too short to count.
SHARED_FN void surface_rebound(ModelPoint* point, const PhaseAt* moment, real h, const mask* hit,
                               const mask* came_up, const real* rates, const real* levels_before,
                               const real* field, const real* rates_behind, real* x) {
  const real zero = 0;
  const real one = 1;
  real levels[MODEL_SURFACES];
  real pushes[MODEL_SURFACES];
  mask rests = zero != zero;
  model_level_values(point, moment, x, levels);
  model_held_rates(point, moment, x, field, pushes);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (!MODEL_RESETS(k)) continue;
    const mask is_reset = hit[k] & (zero < rates[k]);
    const real rate = rates_behind[k];
    const real push = pushes[k];
    // The reset leaves the level what it was, but for rounding.
    const real reach =
        lane_abs(levels_before[k]) + SURFACE_NEAR * h * lane_max(lane_abs(rate), h * push);
    const mask is_at = lane_abs(levels[k]) <= (scalar)(2) * reach;
    // Of a reset that leaves no speed the rate is rounding.
    const real smallest =
        SURFACE_NEAR * rates[k] + surface_rate_rounding(point, moment, x, k, field);
    const mask goes_on = smallest < rate;
    const mask is_above = (is_at & goes_on) | (!is_at & (zero < levels[k]));
    // What only touches it from below goes on there.
    const mask touches = hit[k] & came_up[k] & !is_reset;
    const mask returns = touches | (is_reset & !is_above);
    const real rounding = surface_put_below(point, moment, k, touches | (returns & is_at), x);
    // A flight that is too short, or too low.
    const mask is_short = (scalar)(2) * lane_abs(rate) <= SURFACE_SHORT_FLIGHT * h * push;
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
  surface_return(point, moment, rests, x);
}

#if TANGENTS > 0
// What tangent vectors have across a surface that the motion comes to rest on is lost: in its level
// and in the level's rate.
SHARED_FN void surface_settle_tangents(const ModelPoint* point, const PhaseAt* moment,
                                       const mask* hit, const real* x, real* w) {
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (!MODEL_RESETS(k)) continue;
    const mask rests = hit[k] & point->sides.slides[k];
    if (all_lanes(!rests)) continue;
    real normal[MODEL_STATE_COUNT];
    real turn[MODEL_STATE_COUNT];
    real rates[MODEL_SURFACES];
    surface_normal(point, moment, x, k, normal);
    model_reset_turn(point, moment, x, k, turn);
    model_held_along(point, moment, x, turn, rates);
    const real gain = rates[k];
    for (int j = 0; j < TANGENTS; ++j) {
      real* own = w + j * MODEL_STATE_COUNT;
      real settled[MODEL_STATE_COUNT];
      model_level_along(point, moment, x, own, rates);
      const real level = rates[k];
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) settled[i] = own[i] - level * normal[i];
      model_held_along(point, moment, x, settled, rates);
      const real share = rates[k] / gain;
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
        own[i] = lane_select(rests, settled[i] - share * turn[i], own[i]);
      }
    }
  }
}
#endif
#else
SHARED_FN void surface_reset(const ModelPoint* point, const PhaseAt* moment, const mask* hit,
                             const real* rates, int beside, real* x, real* field, real* w) {
  (void)point, (void)moment, (void)hit, (void)rates, (void)beside, (void)x, (void)field, (void)w;
}
SHARED_FN void surface_rebound(ModelPoint* point, const PhaseAt* moment, real h, const mask* hit,
                               const mask* came_up, const real* rates, const real* levels_before,
                               const real* field, const real* rates_behind, real* x) {
  (void)point, (void)moment, (void)h, (void)hit, (void)came_up, (void)rates, (void)levels_before;
  (void)field, (void)rates_behind, (void)x;
}
SHARED_FN void surface_settle_tangents(const ModelPoint* point, const PhaseAt* moment,
                                       const mask* hit, const real* x, real* w) {
  (void)point, (void)moment, (void)hit, (void)x, (void)w;
}
#endif

// Takes lanes that have come to an event, at a share of the step, to the other side.
SHARED_FN void surface_pass(ModelPoint* point, const SurfaceRows* rows, const SurfaceEvent* event,
                            mask where, int beside, real share, real* x, real* w) {
  const real zero = 0;
  const real one = 1;
  PhaseAt moment;
  mask hit[MODEL_SURFACES];
  mask came_up[MODEL_SURFACES];
  real levels[MODEL_SURFACES];
  real carried[MODEL_STATE_COUNT];  // the field before it, by a reset
  real delays[TANGENT_VECTORS];     // at which tangent vectors come to the surface, negative
  real before[MODEL_STATE_COUNT];
  real behind[MODEL_STATE_COUNT];
  real rates[MODEL_SURFACES];
  real rates_behind[MODEL_SURFACES];
  surface_moment(rows, share, &moment);
  surface_field(point, &moment, x, before, rates);
  model_level_values(point, &moment, x, levels);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) carried[i] = before[i];
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    const mask moves = where & (event->crossed[k] | event->left[k]);
    came_up[k] = point->sides.side[k] < event->side[k];
    point->sides.side[k] = lane_select(moves, event->side[k], point->sides.side[k]);
    point->sides.slides[k] = point->sides.slides[k] & !(where & event->left[k]);
    hit[k] = where & event->crossed[k];
  }
#if TANGENTS > 0
  real sizes[TANGENT_VECTORS];
  if (beside & RK4_LINEAR) {
    surface_delays(point, &moment, x, rates, hit, w, delays);
    for (int j = 0; j < TANGENTS; ++j) sizes[j] = tangent_size(w + j * MODEL_STATE_COUNT);
  }
#endif
  surface_reset(point, &moment, hit, rates, beside, x, carried, w);
  surface_field(point, &moment, x, behind, rates_behind);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (MODEL_RESETS(k)) continue;
    const mask is_pushed_back = hit[k] & (rates_behind[k] * rates[k] < zero);
    const mask is_below = is_pushed_back & (rates[k] < zero);
    point->sides.slides[k] = point->sides.slides[k] | is_pushed_back;
    point->sides.slid = point->sides.slid | is_pushed_back;
    point->sides.side[k] = lane_select(is_below, point->sides.side[k] + one, point->sides.side[k]);
  }
  surface_rebound(point, &moment, rows->h, hit, came_up, rates, levels, behind, rates_behind, x);
  sliding_slope(point, &moment, x, behind);
#if TANGENTS > 0
  if (beside & RK4_LINEAR) {
    for (int j = 0; j < TANGENTS; ++j) {
      UNROLL
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
        const int at = j * MODEL_STATE_COUNT + i;
        w[at] = w[at] + delays[j] * (behind[i] - carried[i]);
      }
    }
    surface_settle_tangents(point, &moment, hit, x, w);
    // What is left of a vector that is lost whole is rounding.
    mask stays = zero != zero;
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) stays = stays | (hit[k] & point->sides.slides[k]);
    for (int j = 0; j < TANGENTS; ++j) {
      real* own = w + j * MODEL_STATE_COUNT;
      const mask is_lost = stays & (tangent_size(own) < TANGENT_LOST * sizes[j]);
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) own[i] = lane_select(is_lost, zero, own[i]);
    }
  }
#else
  (void)delays;
#endif
}

// A motion that a step has left beyond a surface where it should have been reset, since more
// impacts fell into the step than are followed, is no motion of the model: it counts as diverged.
SHARED_FN void surface_refuse(const ModelPoint* point, const SurfaceRows* rows,
                              const mask* has_left, real* x) {
#ifdef MODEL_HAS_RESETS
  const real zero = 0;
  const real one = 1;
  PhaseAt end;
  real levels[MODEL_SURFACES];
  real dx[MODEL_STATE_COUNT];
  real rates[MODEL_SURFACES];
  real pushes[MODEL_SURFACES];
  mask is_beyond = zero != zero;
  surface_moment(rows, one, &end);
  model_level_values(point, &end, x, levels);
  if (all_lanes(levels[0] <= zero) && MODEL_SURFACES == 1) return;
  surface_field(point, &end, x, dx, rates);
  model_held_rates(point, &end, x, dx, pushes);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (!MODEL_RESETS(k)) continue;
    const real reach =
        SURFACE_ON * rows->h * lane_max(lane_abs(rates[k]), rows->h * lane_abs(pushes[k]));
    const mask is_below = point->sides.side[k] == zero;
    is_beyond = is_beyond | (is_below & !has_left[k] & (reach < levels[k]));
    surface_put_below(point, &end, k, is_below & (zero < levels[k]), x);
  }
  x[0] = lane_select(is_beyond, (real)(NAN), x[0]);
#else
  (void)point, (void)rows, (void)has_left, (void)x;
#endif
}

// Advances x by a step, a share of the period, and with it the tangent vectors w where `beside` has
// RK4_LINEAR. Without RK4_CORRECTED nothing is located: the sides are those at the step's start.
SHARED_FN void surfaces_step(ModelPoint* point, const SurfaceRows* rows, scalar share, int beside,
                             real* x, real* w, Watcher* watcher) {
  const real zero = 0;
  const real one = 1;
  const real one_half = (scalar)(0.5);
  const bool is_located = beside & RK4_CORRECTED;
  const mask none = zero != zero;
  mask done = none;
  mask lands = none;  // goes up to an event
  real from = 0;
  real to = 1;
  SurfaceEvent event;
  // In this step, a surface where the state is reset. The level between the rows of the phase
  // coefficients knows the push to first order only, and may rise once more.
  mask has_left[MODEL_SURFACES];
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    has_left[k] = none;
    event.crossed[k] = event.left[k] = none;
    event.side[k] = point->sides.side[k];
  }
  if (!is_located) surfaces_begin(point, rows, x);
  for (int pass = 0; pass < SURFACE_PASSES; ++pass) {
    PhaseAt start;
    PhaseAt middle;
    PhaseAt end;
    Rk4Slopes slopes;
    ModelLinear linear[RK4_EVALUATIONS];
    Crossings crossings;
    real next[MODEL_STATE_COUNT];
    surface_moment(rows, from, &start);
    surface_moment(rows, one_half * (from + to), &middle);
    surface_moment(rows, to, &end);
    const real length = (to - from) * rows->h;
    rk4_advance_by(point, &start, &middle, &end, length, beside, x, next, &slopes, linear,
                   &crossings);
    const SurfacePart part = {rows,    share, from, &to,  length, &start,
                              &middle, &end,  x,    next, &slopes};
    SurfaceEvent found;
    found.any = none;
    if (is_located && pass + 2 < SURFACE_PASSES) surface_find(point, &part, has_left, &found);
    const mask stops = found.any & !lands & !done;
    const mask moves = !done & !stops;
#if TANGENTS > 0
    if (beside & RK4_LINEAR) {
      surface_tangents(point, &part, beside, linear, &crossings, moves, w);
    }
#endif
    surface_return(point, &end, moves, next);
    if (!all_lanes(!lands)) surface_land(point, rows, &event, lands, &to, next);
    if (beside & RK4_MIDDLE) watch_part(watcher, point, &part, moves);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = lane_select(moves, next[i], x[i]);
    from = lane_select(moves, to, from);
    if (!all_lanes(!lands)) {
      surface_pass(point, rows, &event, lands, beside, from, x, w);
      if (beside & RK4_MIDDLE) watch_side(watcher, point, rows, from, lands, x);
    }
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      if (MODEL_RESETS(k)) has_left[k] = has_left[k] | (lands & event.left[k]);
    }
    done = done | (moves & !lands);
    if (all_lanes(done)) break;
    if (is_located && pass + 2 < SURFACE_PASSES) {
      UNROLL
      for (int k = 0; k < MODEL_SURFACES; ++k) {
        event.crossed[k] = lane_select(stops, found.crossed[k], event.crossed[k]);
        event.left[k] = lane_select(stops, found.left[k], event.left[k]);
        event.side[k] = lane_select(stops, found.side[k], event.side[k]);
      }
    }
    to = lane_select(stops, from + found.after * (one - from), one);
    lands = stops;
  }
  if (is_located) surface_refuse(point, rows, has_left, x);
}

#endif
