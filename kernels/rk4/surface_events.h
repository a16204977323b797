// Where a part of a step comes to a surface, or leaves one that it stays at.

#include "rk4/level_cross.h"
#include "rk4/surface_part.h"

#ifdef MODEL_SURFACES

// A share of the distance that a level goes in a step: nearer than that to a surface a motion is on
// it.
#define SURFACE_NEAR LEVEL_NEAR
// The same where the state is reset: a motion that has just met it must not count as beyond it.
#define SURFACE_ON ((scalar)(REAL_BITS == 64 ? 1e-6 : 1e-3))

// What ends a step, or a part of it.
typedef struct {
  mask any;
  real after;  // share of the part at which it lies
  // Whether this surface is crossed; whether the motion leaves it after it slid along it; and the
  // side on which it goes on.
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
SHARED_FN void surface_find_rest(ModelPoint* point, const PhaseAt* moment, real h, const real* x,
                                 int surface, real level, mask where) {
  const real zero = 0;
  real dx[MODEL_STATE_COUNT];
  real rates[MODEL_SURFACES];
  real pushes[MODEL_SURFACES];
  surface_field(point, moment, x, dx, rates);
  model_held_rates(point, moment, x, dx, pushes);
  const real rate = lane_abs(rates[surface]);
  const real push = pushes[surface];
  const mask near =
      where & (lane_abs(level) <= SURFACE_ON * h * lane_max(rate, h * lane_abs(push)));
  point->sides.side[surface] = lane_select(near, zero, point->sides.side[surface]);
  point->sides.slides[surface] =
      point->sides.slides[surface] | (near & (zero < push) & (rate <= SURFACE_NEAR * h * push));
}

// On a jump the fields of both sides decide: where both lead to one side, that one; where both push
// towards it, the motion slides; where both lead away, it goes on above. How near that is the rate
// on the state's own side says: off the surface the other field means nothing, and may be infinite.
SHARED_FN void surface_find_side(ModelPoint* point, const PhaseAt* moment, real h, const real* x,
                                 int surface, real level, mask where) {
  const real zero = 0;
  const real one = 1;
  const real above_side = MODEL_STAIRCASE(surface) ? lane_rint(level) : one;
  ModelPoint above = *point;
  ModelPoint below = *point;
  real dx[MODEL_STATE_COUNT];
  real rates_above[MODEL_SURFACES];
  real rates_below[MODEL_SURFACES];
  above.sides.side[surface] = above_side;
  below.sides.side[surface] = above_side - one;
  surface_field(&above, moment, x, dx, rates_above);
  surface_field(&below, moment, x, dx, rates_below);
  const real up = rates_above[surface];
  const real down = rates_below[surface];
  const real distance = level - surface_level(surface, above_side);
  const real own = lane_select(distance < zero, down, up);
  const mask near = where & (lane_abs(distance) <= SURFACE_NEAR * h * lane_abs(own));
  const mask slides = near & (up < zero) & (zero < down);
  const mask falls = near & (up < zero) & !slides;
  const mask rises = near & !(up < zero);
  const real side = lane_select(falls, above_side - one, point->sides.side[surface]);
  point->sides.side[surface] = lane_select(slides | rises, above_side, side);
  point->sides.slides[surface] = point->sides.slides[surface] | slides;
}

// The sides of surfaces in these lanes, by the state alone.
SHARED_FN void surfaces_find_sides(ModelPoint* point, const PhaseAt* moment, real h, const real* x,
                                   const real* levels, const mask* where) {
  const real zero = 0;
  const real one = 1;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    const real whole = lane_floor(levels[k]);
    const real upper = lane_select(zero < levels[k], one, zero);
    point->sides.side[k] =
        lane_select(where[k], MODEL_STAIRCASE(k) ? whole : upper, point->sides.side[k]);
    point->sides.slides[k] = point->sides.slides[k] & !where[k];
  }
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (all_lanes(!where[k])) continue;
    if (MODEL_RESETS(k)) {
      surface_find_rest(point, moment, h, x, k, levels[k], where[k]);
    } else {
      surface_find_side(point, moment, h, x, k, levels[k], where[k]);
    }
  }
  point->sides.slid = point->sides.slid | sliding_any(point);
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

// Whether nothing holds a motion at a surface that it is to slide along, with this share.
SHARED_FN mask surface_is_out(int surface, real share) {
  const real one = 1;
  const real most = MODEL_RESETS(surface) ? (real)(INFINITY) : one;
  return (share < -SURFACE_NEAR) | (most + SURFACE_NEAR < share);
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
    const mask starts_out = surface_is_out(k, first.share[k]);
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
      // The end that stays counts half from now on (the Illinois method).
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
SHARED_FN void surface_find(const ModelPoint* point, const SurfacePart* part, SurfaceEvent* event) {
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
    const real first = part->length * r0[k];
    const real last = part->length * r1[k];
    if (all_lanes(!level_may_cross(l0[k], l1[k], first, last, up, down))) continue;
    const mask hit = level_cross(l0[k], l1[k], first, last, up, down, &after, &is_up);
    surface_take(event, hit & !point->sides.slides[k] & (after < event->after), after, k, hit,
                 lane_select(is_up, side + one, side - one));
  }
  if (!all_lanes(!sliding_any(point))) surface_find_leaving(point, part, event);
}

#endif
