// The kernel that looks inside a point: every state at both ends of every step.
#include "items.h"

// Keeps the states: rows is [row][state][item].
typedef struct {
  __global real* rows;
  uint row;  // the next
  uint items, item;
} Watcher;

SHARED_FN void keep_row(Watcher* watcher, const real* x) {
  store_components(watcher->rows, watcher->items, watcher->item, watcher->row++ * MODEL_STATE_COUNT,
                   MODEL_STATE_COUNT, x);
}

#include "rk4/surface_part.h"

#ifdef MODEL_SURFACES
SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, const SurfaceRows* rows,
                             const real* x) {
  keep_row(watcher, x);
}

SHARED_FN void watch_part(Watcher* watcher, const ModelPoint* point, const SurfacePart* part,
                          mask where) {}

SHARED_FN void watch_side(Watcher* watcher, const ModelPoint* point, const SurfaceRows* rows,
                          real share, mask where, const SurfaceMet* met, const real* x) {}

SHARED_FN void watch_step_end(Watcher* watcher, const real* x) { keep_row(watcher, x); }
#else
SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                             const real* x) {
  keep_row(watcher, x);
}

SHARED_FN void watch_step(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                          scalar share, const real* middle, const real* x) {
  keep_row(watcher, x);
}
#endif

#include "walk.h"

// Advances by whole periods and keeps the states; in a period each segment has one row more than
// steps, from its beginning to its end. An item whose points have all diverged leaves its rows as
// they were.
__kernel void trace(const SweepRound round, PARAMETER_TABLES, GRID_TABLES, __global real* state,
                    __global real* rows) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  Watcher watcher = {rows, 0, items, item};
  for (uint period = 0; period < round.periods; ++period) {
    walk_period(&point, &grid, EVENTS, WALK_WATCHED, x, 0, 0, 0, &watcher);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}
