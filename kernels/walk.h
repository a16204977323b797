// The walk over the phase grid. All kernels advance a state by it, and so does the host where it
// checks the kernels. A file that includes this one defines before it: TANGENTS, STATE_LIMITS (of
// each state the size from which on it has diverged, as an initialiser), the type Watcher, and
//   watch_segment(watcher, point, stage, x)  called when a segment begins
//   watch_step(watcher, held, stage, share, middle, x)
//                                            called when a step has ended, with the states in its
//                                            middle and at its end; share: of a period
// For a model with surfaces (MODEL_SURFACES), whose steps are cut (rk4/surfaces.h), instead of
// these
//   watch_segment(watcher, point, rows, x)   the same
//   watch_part(watcher, point, part, where)  called when a part of a step has ended in these lanes
//   watch_side(watcher, point, rows, share, where, met, x)
//                                            called when these have changed a side; met: the
//                                            surfaces that reset the state there
//   watch_step_end(watcher, x)               called when a step has ended
// unwatched.h defines a watcher that does nothing.

#include "rk4/surfaces.h"
#include "walk_types.h"

// Ends a period: sets a state that has diverged to NaN, and takes full turns out of angles. What is
// infinite, or no number, is below no limit.
SHARED_FN void end_period(real* x) {
  const scalar limits[MODEL_STATE_COUNT] = STATE_LIMITS;
  mask inside = lane_abs(x[0]) < limits[0];
  UNROLL
  for (int i = 1; i < MODEL_STATE_COUNT; ++i) inside = inside & (lane_abs(x[i]) < limits[i]);
  x[0] = lane_select(inside, x[0], (real)(NAN));
  model_take_turns(x);
}

// What a walk does beside advancing a state: a sum of these. A pointer that is not asked for may be
// null; none is compared with null, for a compiler may then keep what it points to in memory (a
// null of a GPU's private memory need not be 0).
enum {
  WALK_TANGENTS = 1,     // the vectors w are advanced, too
  WALK_STRETCHINGS = 2,  // these are kept orthonormal, and their log stretching is added
  WALK_EXTENT = 4,       // the extent is widened to what the state moves through
  WALK_WATCHED = 8       // the watcher is shown each segment and step
};

#ifdef MODEL_SURFACES
SHARED_FN void walk_orthonormalize(ModelPoint* point, real* w, real* log_stretching) {
  const real zero = 0;
  tangent_orthonormalize(point->sides.slid, w, log_stretching);
  point->sides.slid = zero != zero;
}
#else
SHARED_FN void walk_orthonormalize(const ModelPoint* point, real* w, real* log_stretching) {
  (void)point;
  tangent_orthonormalize(0, w, log_stretching);
}
#endif

// What the magnitudes of all states make of each in a period, by the field's derivative at phase 0:
// rounding of theirs makes the same share of it.
SHARED_FN void walk_magnitudes(const ModelPoint* point, TABLE PhaseCoefs* stage, const real* x,
                               Extent* extent) {
  const real zero = 0;
  const real one = 1;
  const PhaseCoefs coefs = stage[0];
  const PhaseAt phase = phase_at(&coefs);
  ModelLinear linear;
  real zeros[MODEL_STATE_COUNT];
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) zeros[i] = 0;
  model_linearize(point, &phase, x, one, &linear);
  for (int j = 0; j < MODEL_STATE_COUNT; ++j) {
    real alone[MODEL_STATE_COUNT];
    real made[MODEL_STATE_COUNT];
    const real size = lane_max(lane_abs(extent->low[j]), lane_abs(extent->high[j]));
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) alone[i] = i == j ? size : zero;
    model_tangent(point, &linear, alone, zeros, made);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      extent->made[i] = extent->made[i] + point->period * lane_abs(made[i]);
    }
  }
}

// Advances a state by a period. All of this is inlined, so what is not asked for costs nothing.
// events: steps in which a limit of the contact is crossed are corrected.
SHARED_FN void walk_period(const ModelPoint* point, const WalkGrid* grid, bool events, int beside,
                           real* x, real* w, real* log_stretching, Extent* extent,
                           Watcher* watcher) {
  TABLE PhaseCoefs* stage = grid->stages;
  const bool is_watched = beside & WALK_WATCHED;
  const int step_beside = (events ? RK4_CORRECTED : 0) | (is_watched ? RK4_MIDDLE : 0);
  real middle[MODEL_STATE_COUNT];
#ifdef MODEL_SURFACES
  ModelPoint own = *point;  // its sides change on the way
  ModelPoint* held = &own;
  own.sides.slid = !(x[0] == x[0]);
  (void)middle;
#else
  const ModelPoint* held = point;
#endif
  for (sweep_uint segment = 0; segment < grid->segments; ++segment) {
    const sweep_uint steps = grid->steps[segment];
    const scalar share = grid->fractions[segment];
    const real h = share * point->period;
    const bool is_last = segment + 1 == grid->segments;
#ifdef MODEL_SURFACES
    SurfaceRows rows = surface_rows(held, stage, h);
    surfaces_begin(held, &rows, x);
    if (is_watched) watch_segment(watcher, held, &rows, x);
#else
    if (is_watched) watch_segment(watcher, held, stage, x);
#endif
    for (sweep_uint step = 0; step < steps; ++step) {
#ifdef MODEL_SURFACES
      rows = surface_rows(held, stage, h);
      surfaces_step(held, &rows, share, step_beside | (beside & WALK_TANGENTS ? RK4_LINEAR : 0), x,
                    w, watcher);
#else
      if (beside & WALK_TANGENTS) {
        tangent_step(held, stage, h, step_beside, x, middle, w);
      } else {
        rk4_step(held, stage, h, step_beside, x, middle);
      }
#endif
      if (beside & WALK_TANGENTS && beside & WALK_STRETCHINGS &&
          TANGENT_IS_DUE(step, is_last && step + 1 == steps)) {
        walk_orthonormalize(held, w, log_stretching);
      }
      if (beside & WALK_EXTENT && step % EXTENT_EVERY == 0) extent_widen(x, extent);
      stage += RK4_STAGES_PER_STEP;
#ifdef MODEL_SURFACES
      if (is_watched) watch_step_end(watcher, x);
#else
      if (is_watched) watch_step(watcher, held, stage, share, middle, x);
#endif
    }
    stage += 1;
  }
  if (beside & WALK_EXTENT) walk_magnitudes(held, grid->stages, x, extent);
  end_period(x);
}
