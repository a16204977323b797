// The walk over the phase grid. All kernels advance a state by it, and so does the host where it
// checks the kernels. A file that includes this one defines before it: TANGENTS, the type Watcher,
// and
//   watch_segment(watcher, point, stage, x)  called when a segment begins
//   watch_step(watcher, point, stage, share, middle, x)
//                                            called when a step has ended, with the states in its
//                                            middle and at its end; share: of a period
// unwatched.h defines a watcher that does nothing.

#include "walk_types.h"

// Ends a period: sets a state that has diverged to NaN, and takes full turns out of angles.
SHARED_FN void end_period(real* x) {
  const real limit = (scalar)(SWEEP_DIVERGED_BEYOND);
  mask inside = lane_abs(x[0]) < limit;
  UNROLL
  for (int i = 1; i < MODEL_STATE_COUNT; ++i) inside = inside & (lane_abs(x[i]) < limit);
  x[0] = lane_select(inside, x[0], (real)(NAN));
  model_take_turns(x);
}

// Advances a state by a period. Four arguments may be null, and then their work is left out (all of
// this is inlined, so it costs nothing):
//   w               tangent vectors, which are advanced, too
//   log_stretching  the vectors are kept orthonormal, and their log stretching is added here
//   extent          is widened to what the state moves through
//   watcher         is shown each segment and step
// events: steps in which a limit of the contact is crossed are corrected.
SHARED_FN void walk_period(const ModelPoint* point, const WalkGrid* grid, bool events, real* x,
                           real* w, real* log_stretching, Extent* extent, Watcher* watcher) {
  TABLE PhaseCoefs* stage = grid->stages;
  real middle[MODEL_STATE_COUNT];
  for (sweep_uint segment = 0; segment < grid->segments; ++segment) {
    const sweep_uint steps = grid->steps[segment];
    const scalar share = grid->fractions[segment];
    const real h = share * point->period;
    const bool is_last = segment + 1 == grid->segments;
    if (watcher) watch_segment(watcher, point, stage, x);
    for (sweep_uint step = 0; step < steps; ++step) {
      if (w) {
        tangent_step(point, stage, h, events, x, watcher ? middle : 0, w);
        if (log_stretching && TANGENT_IS_DUE(step, is_last && step + 1 == steps)) {
          tangent_orthonormalize(w, log_stretching);
        }
      } else {
        rk4_step(point, stage, h, events, x, watcher ? middle : 0);
      }
      if (extent && step % EXTENT_EVERY == 0) extent_widen(x, extent);
      stage += RK4_STAGES_PER_STEP;
      if (watcher) watch_step(watcher, point, stage, share, middle, x);
    }
    stage += 1;
  }
  end_period(x);
}
