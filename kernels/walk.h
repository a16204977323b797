// The one walk over the phase grid: all kernels, and the host where it checks them, advance a state
// by it. Before it is included it wants TANGENTS, the type Watcher of who watches steps, and
//   watch_segment(watcher, point, stage, x)      a segment begins
//   watch_step(watcher, point, stage, share, x)  a step has ended, which is this share of a period
// Where nobody watches these are in unwatched.h.

#include "walk_types.h"

// What a period's end does to a state: marks it where it has diverged, takes full turns out of
// angles.
SHARED_FN void end_period(real* x) {
  const real limit = (scalar)(SWEEP_DIVERGED_BEYOND);
  mask inside = lane_abs(x[0]) < limit;
  UNROLL
  for (int i = 1; i < MODEL_STATE_COUNT; ++i) inside = inside & (lane_abs(x[i]) < limit);
  x[0] = lane_select(inside, x[0], (real)(NAN));
  model_take_turns(x);
}

// Advances a state by a period, and with it the tangent vectors, unless w is null. They are kept
// orthonormal and their growth is added to `growth`, unless that is null. Widens the extent, unless
// it is null, and shows the steps to the watcher, unless that is null. `events`: steps in which a
// limit of the contact is crossed are corrected. What is null costs nothing, since this is inlined.
SHARED_FN void walk_period(const ModelPoint* point, const WalkGrid* grid, bool events, real* x,
                           real* w, real* growth, Extent* extent, Watcher* watcher) {
  TABLE PhaseCoefs* stage = grid->stages;
  for (sweep_uint segment = 0; segment < grid->segments; ++segment) {
    const sweep_uint steps = grid->steps[segment];
    const scalar share = grid->fractions[segment];
    const real h = share * point->period;
    const bool is_last = segment + 1 == grid->segments;
    if (watcher) watch_segment(watcher, point, stage, x);
    for (sweep_uint step = 0; step < steps; ++step) {
      if (w) {
        tangent_step(point, stage, h, events, x, w);
        if (growth && TANGENT_IS_DUE(step, is_last && step + 1 == steps)) {
          tangent_orthonormalize(w, growth);
        }
      } else {
        rk4_step(point, stage, h, events, x);
      }
      if (extent && step % EXTENT_EVERY == 0) extent_widen(x, extent);
      stage += RK4_STAGES_PER_STEP;
      if (watcher) watch_step(watcher, point, stage, share, x);
    }
    stage += 1;
  }
  end_period(x);
}
