// The kernel that looks inside a point: every state at both ends of every step.
#include "items.h"

// Advances by whole periods and keeps the states. rows is [row][state][item]; in a period each
// segment has one row more than steps, from its beginning to its end. An item whose points have all
// diverged leaves its rows as they were.
__kernel void trace(const SweepRound round, TABLE scalar* uniform, TABLE real* swept, GRID_TABLES,
                    __global real* state, __global real* rows) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const SweepGrid grid = grids[item_grid[item]];

  uint row = 0;
  for (uint period = 0; period < round.periods; ++period) {
    TABLE PhaseCoefs* stage = stages + grid.first_stage;
    for (uint segment = 0; segment < grid.segments; ++segment) {
      const uint steps = segment_steps[grid.first_segment + segment];
      const real h = segment_fractions[grid.first_segment + segment] * point.period;
      store_components(rows, items, item, row++ * MODEL_STATE_COUNT, MODEL_STATE_COUNT, x);
      for (uint step = 0; step < steps; ++step) {
        rk4_step(&point, stage, h, EVENTS, x);
        stage += RK4_STAGES_PER_STEP;
        store_components(rows, items, item, row++ * MODEL_STATE_COUNT, MODEL_STATE_COUNT, x);
      }
      stage += 1;
    }
    end_period(x);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}
