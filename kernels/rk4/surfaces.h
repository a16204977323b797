// Steps of a model with surfaces (MODEL_SURFACES): places where the equations jump, or where the
// state is reset. A step is taken on the side of each surface that the motion is on. Where it ends
// on another side, it is taken anew up to the crossing, which the cubic of the level through both
// ends tells and Newton's method on the way itself then makes exact, and the rest is taken on the
// other side. Each lane does that by itself: those that have nothing to cross are done after the
// first pass.

#include "rk4/surface_events.h"
#include "rk4/surface_part.h"
#include "rk4/surface_rest.h"
#include "rk4/surface_tangents.h"

#ifdef MODEL_SURFACES

#define SURFACE_PASSES 1024  // each crossing takes two

// The sides at a state where nothing is known of the way there.
SHARED_FN void surfaces_begin(ModelPoint* point, const SurfaceRows* rows, const real* x) {
  const real zero = 0;
  PhaseAt moment;
  real levels[MODEL_SURFACES];
  mask all[MODEL_SURFACES];
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) all[k] = zero == zero;
  surface_moment(rows, zero, &moment);
  model_level_values(point, &moment, x, levels);
  surfaces_find_sides(point, &moment, rows->h, x, levels, all);
  surface_bind_resting(point, &moment, rows->h, x);
}

// How much later the motion is on a surface. A flight between impacts has two ends: of the parabola
// through both, the later one; of a dip below the surface, which is its mirror in time, the
// earlier.
SHARED_FN real surface_delay(const ModelPoint* point, const PhaseAt* moment, const real* x,
                             const real* dx, int surface, real level, real rate, mask rises) {
  const real zero = 0;
  const real one = 1;
  const real two = 2;
  real later = -level / rate;
#ifdef MODEL_HAS_RESETS
  if (MODEL_RESETS(surface)) {
    real pushes[MODEL_SURFACES];
    model_held_rates(point, moment, x, dx, pushes);
    const real push = pushes[surface];
    const real way = lane_select(rises, one, -one);
    const real speed = way * rate;
    const real root = lane_sqrt(lane_max(rate * rate - two * push * level, zero));
    const real behind = -two * level / (speed + root);
    const real ahead = (root - speed) / push;
    later = lane_select(zero < push, way * lane_select(zero < speed, behind, ahead), later);
  }
#else
  (void)point, (void)moment, (void)x, (void)dx, (void)surface, (void)zero, (void)one, (void)two;
  (void)rises;
#endif
  return later;
}

// Takes lanes that have come to a surface, at a share of the step, onto it by Newton's method; not
// back to `from`, where the part began: of a motion that has just left a surface at which it rested
// the cubic of the level may be wrong by rounding alone, and Newton's method knows no bound.
SHARED_FN void surface_land(const ModelPoint* point, const SurfaceRows* rows,
                            const SurfaceEvent* event, mask where, real from, real* share,
                            real* x) {
  const real zero = 0;
  const real longest = (scalar)(0.01) * rows->h;
  const real earliest = from + (scalar)(0.5) * (*share - from);
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
      const mask rises = point->sides.side[k] < event->side[k];
      const real later = surface_delay(point, &moment, x, dx, k, -level, rates[k], rises);
      delay = lane_select(counts, lane_clamp(later, -longest, longest), delay);
    }
    delay = lane_max(delay, (earliest - *share) * rows->h);
    UNROLL
    for (int j = 0; j < MODEL_STATE_COUNT; ++j) x[j] = x[j] + delay * dx[j];
    *share = *share + delay / rows->h;
  }
}

// Takes lanes that have come to an event, at a share of the step, to the other side. cuts: of the
// step, so far.
SHARED_FN void surface_pass(ModelPoint* point, const SurfaceRows* rows, const SurfaceEvent* event,
                            mask where, int beside, real share, real cuts, real* x, real* w,
                            SurfaceMet* met) {
  const real zero = 0;
  const real one = 1;
  PhaseAt moment;
  mask hit[MODEL_SURFACES];
  mask touched[MODEL_SURFACES];  // from below, and not gone through
  mask rises[MODEL_SURFACES];
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
    const real upper = point->sides.side[k];  // of one that it slid along
    const mask came_up = upper < event->side[k];
    rises[k] = came_up;
    point->sides.side[k] = lane_select(moves, event->side[k], point->sides.side[k]);
    point->sides.slides[k] = point->sides.slides[k] & !(where & event->left[k]);
    if (!MODEL_RESETS(k) && !all_lanes(!(where & event->left[k]))) {
      const mask above = !(event->side[k] < upper);
      (void)surface_put_beside(point, &moment, k, surface_level(k, upper), above,
                               where & event->left[k], x);
    }
    hit[k] = where & event->crossed[k];
    met->hit[k] = MODEL_RESETS(k) ? hit[k] & came_up & (zero < rates[k]) : zero != zero;
    met->rate[k] = met->behind[k] = rates[k];
    met->in_place[k] = met->hit[k];
    touched[k] = hit[k] & came_up & !met->hit[k];
  }
#if TANGENTS > 0
  if (beside & RK4_LINEAR) surface_delays(point, &moment, x, rates, hit, w, delays);
#endif
  surface_resets(point, &moment, rows->h, beside, x, carried, w, met);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) point->sides.slid = point->sides.slid | met->hit[k];
  surface_field(point, &moment, x, behind, rates_behind);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    if (MODEL_RESETS(k)) continue;
    const real onwards = lane_select(rises[k], rates_behind[k], -rates_behind[k]);
    const mask is_pushed_back = hit[k] & (onwards < zero);
    const mask is_below = is_pushed_back & !rises[k];
    point->sides.slides[k] = point->sides.slides[k] | is_pushed_back;
    point->sides.slid = point->sides.slid | is_pushed_back;
    point->sides.side[k] = lane_select(is_below, point->sides.side[k] + one, point->sides.side[k]);
    // What stands still behind it, as an integrator that is held at its limit, stays on that side.
    const mask stands =
        hit[k] & !is_pushed_back & (lane_abs(rates_behind[k]) <= SURFACE_NEAR * lane_abs(rates[k]));
    if (all_lanes(!stands)) continue;
    const real side = point->sides.side[k];
    const real at = surface_level(k, lane_select(rises[k], side, side + one));
    (void)surface_put_beside(point, &moment, k, at, rises[k], stands, x);
  }
  surface_rebound(point, &moment, rows->h, cuts, hit, touched, met, levels, x);
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
  }
#else
  (void)delays;
#endif
}

// Advances x by a step, a share of the period, and with it the tangent vectors w where `beside` has
// RK4_LINEAR. Without RK4_CORRECTED nothing is located: the sides are those at the step's start.
// What has more to cross than is followed, as where two jumps make a motion switch without end,
// counts as diverged.
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
  real cuts = 0;
  SurfaceEvent event;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
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
    if (pass == 0) {
      start = rows->row[0];
      middle = rows->row[1];
      end = rows->row[2];
    } else {
      surface_moment(rows, from, &start);
      surface_moment(rows, one_half * (from + to), &middle);
      surface_moment(rows, to, &end);
    }
    const real length = (to - from) * rows->h;
    rk4_advance_by(point, &start, &middle, &end, length, beside, x, next, &slopes, linear,
                   &crossings);
    const SurfacePart part = {rows,    share, from, &to,  length, &start,
                              &middle, &end,  x,    next, &slopes};
    SurfaceEvent found = event;
    found.any = none;
    if (is_located) surface_find(point, &part, &found);
    const mask stops = found.any & !lands & !done;
    const mask moves = !done & !stops;
#if TANGENTS > 0
    if (beside & RK4_LINEAR) {
      surface_tangents(point, &part, beside, linear, &crossings, moves, w);
    }
#endif
    surface_return(point, &end, rows->h, moves, next);
    if (!all_lanes(!lands)) surface_land(point, rows, &event, lands, from, &to, next);
    if (beside & RK4_MIDDLE) watch_part(watcher, point, &part, moves);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) x[i] = lane_select(moves, next[i], x[i]);
    if (pass == 0 && all_lanes(moves)) return;
    from = lane_select(moves, to, from);
    if (!all_lanes(!lands)) {
      SurfaceMet met;
      surface_pass(point, rows, &event, lands, beside, from, cuts, x, w, &met);
      if (beside & RK4_MIDDLE) watch_side(watcher, point, rows, from, lands, &met, x);
    }
    done = done | (moves & !lands);
    if (all_lanes(done)) break;
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      event.crossed[k] = lane_select(stops, found.crossed[k], event.crossed[k]);
      event.left[k] = lane_select(stops, found.left[k], event.left[k]);
      event.side[k] = lane_select(stops, found.side[k], event.side[k]);
    }
    to = lane_select(stops, from + found.after * (one - from), one);
    lands = stops;
    cuts = lane_select(stops, cuts + one, cuts);
  }
  x[0] = lane_select(done, x[0], (real)(NAN));
}

#endif
