// The kernels that look for the periodic orbit that a point is settling on.
#include "dialect.h"
#include "selection.h"

// A return map's derivative takes a tangent vector along each state.
#undef TANGENTS
#define TANGENTS MODEL_STATE_COUNT
#include "items.h"

// Settles by up to ORBIT_LONGEST periods in one or more rounds, and says after how many of them, n,
// the state was within near / n^2 (times its greatest component) of where it began, start
// ([state][item]). Motion on a torus comes back to within about 1 / n^2 of its size for some n by
// itself (Dirichlet's theorem). returns is [item]: the sum of 2^(n - 1) over these n.
__kernel void approach(const SweepRound round, TABLE scalar* uniform, TABLE real* swept,
                       GRID_TABLES, __global real* state, const scalar near, __global real* start,
                       __global real* returns) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const real zero = 0;
  real from[MODEL_STATE_COUNT];
  real found = 0;
  if (round.recorded == 0) {
    store_components(start, items, item, 0, MODEL_STATE_COUNT, x);
  } else {
    found = returns[item];
  }
  load_components(start, items, item, 0, MODEL_STATE_COUNT, from);
  real scale = 0;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) scale = lane_max(scale, lane_abs(from[i]));

  for (uint period = 0; period < round.periods; ++period) {
    advance_periods(1, &point, grids[item_grid[item]], segment_steps, segment_fractions, stages, x,
                    0, 0);
    real distance = 0;
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      distance = lane_max(distance, lane_abs(x[i] - from[i]));
    }
    const uint lag = round.recorded + period + 1;
    const scalar within = near / (scalar)(lag * lag);
    const scalar bit = (scalar)(1u << (lag - 1));
    found = found + lane_select(distance <= within * scale, (real)(bit), zero);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  returns[item] = found;
}

// Goes on to the state after item_periods[item] periods, in one or more rounds, and to the
// derivative of this map, which is [column][row][item] and begins as the identity.
__kernel void return_map(const SweepRound round, TABLE scalar* uniform, TABLE real* swept,
                         GRID_TABLES, __global real* state, TABLE uint* item_periods,
                         __global real* derivative) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  if (round.recorded >= item_periods[item]) return;
  real w[TANGENT_NUMBERS];
  load_many(derivative, items, item, 0, TANGENT_NUMBERS, w);
  advance_periods(min(round.periods, item_periods[item] - round.recorded), &point,
                  grids[item_grid[item]], segment_steps, segment_fractions, stages, x, w, 0);
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  store_many(derivative, items, item, 0, TANGENT_NUMBERS, w);
}
