// What every kernel does with the items of a tile: parameters, states, distances of states.
//
// Build macros: REAL_BITS (32, 64), LANES (1, 2, 4, 8, 16), CONTRACT (0: no fused multiply-add),
// EVENTS (1: steps that cross a limit of the contact are corrected).
// The host writes selection.h for each study: the model with its integrator, and
//   MODEL_OPTION_VALUES             the model's options, as an initialiser
//   TANGENTS                        tangent vectors that travel with a state
//   RANGE_GROUPS                    of each state the number of its group, as an initialiser
//   STATE_LIMITS                    a state that is not below its limit has diverged
//
// Device buffers are structures of arrays: state, tangents, swept, accumulators and outputs are
// [component][item], each element a `real` of LANES neighbouring points.

#include "dialect.h"
#include "selection.h"
#include "sweep_types.h"
#include "tangent.h"
#include "walk_types.h"

// The parameters of a tile, in the model's order. `uniform` has one value of each. `swept` has a
// row for each parameter that is an axis, with a value for each point. `swept_rows` has the row of
// each parameter, or NOT_SWEPT. So a program does not depend on the study's axes. The last number
// of `uniform` is the period that time is counted in where there is no clock.
#define PARAMETER_TABLES TABLE scalar *uniform, TABLE uint *swept_rows, TABLE real *swept

#define LOAD_PARAMETER(name, unit, value, min, max, shapes_phase, meaning)                      \
  parameters.name = swept_rows[number] == NOT_SWEPT ? (real)(uniform[number])                   \
                                                    : swept[swept_rows[number] * items + item]; \
  ++number;

// A point that has diverged carries NaN in its first state: from then on it stays out of the maps.
#define IS_DIVERGED(x) ((x)[0] != (x)[0])

SHARED_FN void load_point(uint items, uint item, PARAMETER_TABLES, ModelPoint* point) {
  const ModelOptions options = MODEL_OPTION_VALUES;
  ModelParameters parameters;
  int number = 0;
  MODEL_PARAMETERS(LOAD_PARAMETER)
  model_prepare(&parameters, options, point);
#ifdef MODEL_CLOCKLESS
  point->period = uniform[number];
#endif
}

SHARED_FN void load_components(__global const real* buffer, uint items, uint item, uint first,
                               int count, real* values) {
  UNROLL
  for (int i = 0; i < count; ++i) values[i] = buffer[(size_t)(first + i) * items + item];
}

SHARED_FN void store_components(__global real* buffer, uint items, uint item, uint first, int count,
                                const real* values) {
  UNROLL
  for (int i = 0; i < count; ++i) buffer[(size_t)(first + i) * items + item] = values[i];
}

// The same for more numbers than are worth unrolling.
SHARED_FN void load_many(__global const real* buffer, uint items, uint item, uint first, int count,
                         real* values) {
  for (int i = 0; i < count; ++i) values[i] = buffer[(size_t)(first + i) * items + item];
}

SHARED_FN void store_many(__global real* buffer, uint items, uint item, uint first, int count,
                          const real* values) {
  for (int i = 0; i < count; ++i) buffer[(size_t)(first + i) * items + item] = values[i];
}

// Loads an item's states and parameters; false when there is nothing to advance.
SHARED_FN bool take_item(uint items, uint item, PARAMETER_TABLES, __global const real* state,
                         real* x, ModelPoint* point) {
  if (item >= items) return false;
  load_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  if (all_lanes(IS_DIVERGED(x))) return false;
  load_point(items, item, uniform, swept_rows, swept, point);
  return true;
}
#define TAKE_ITEM(x, point) take_item(items, item, uniform, swept_rows, swept, state, x, point)

// The smallest difference between two states that is taken for real, relative to the state: 64
// units in the last place.
#define ROUNDINGS_TOLD ((scalar)(REAL_BITS == 64 ? 64 * 2.220446e-16 : 64 * 1.1920929e-7))

// What distances between states are relative to: for each state the range of the motion, whatever
// the offset. A range must not be so small that `tolerance` times it drowns in rounding, that of
// the state or of those that change it: of a mass at rest the speed is rounding of its place.
SHARED_FN void extent_ranges(const Extent* extent, scalar tolerance, real* ranges) {
  const scalar smallest = ROUNDINGS_TOLD / tolerance;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real largest = lane_max(lane_abs(extent->low[i]), lane_abs(extent->high[i]));
    const real rounded = lane_max(largest, extent->made[i]);
    ranges[i] = lane_max(extent->high[i] - extent->low[i], smallest * rounded);
  }
}

// States of one group share the largest of their ranges: what is driven weakly, or not at all any
// more, is not measured by itself. The model declares groups. Of states that it does not put into
// one nothing is known that makes them comparable: units say nothing, as they can be chosen.
SHARED_FN void share_ranges(const real* ranges, real* shared) {
  const int groups[MODEL_STATE_COUNT] = RANGE_GROUPS;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    shared[i] = ranges[i];
    UNROLL
    for (int j = 0; j < MODEL_STATE_COUNT; ++j) {
      if (groups[j] == groups[i]) shared[i] = lane_max(shared[i], ranges[j]);
    }
  }
}

// x - y, each component relative to its range. What differs in a component without any range is as
// far apart as can be.
SHARED_FN void relative_difference(const real* x, const real* y, const real* ranges, real* apart) {
  const real zero = 0;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) apart[i] = x[i] - y[i];
  model_take_turns(apart);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    const real at_rest = lane_select(apart[i] == zero, zero, (real)(INFINITY));
    apart[i] = lane_select(zero < ranges[i], apart[i] / ranges[i], at_rest);
  }
}

SHARED_FN real max_size(const real* components) {
  real largest = 0;
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    largest = lane_max(largest, lane_abs(components[i]));
  }
  return largest;
}

// Where the phase grids of a tile lie.
#define GRID_TABLES                                                         \
  TABLE uint *item_grid, TABLE SweepGrid *grids, TABLE uint *segment_steps, \
      TABLE scalar *segment_fractions, TABLE PhaseCoefs *stages

SHARED_FN WalkGrid find_grid(uint item, GRID_TABLES) {
  const SweepGrid place = grids[item_grid[item]];
  const WalkGrid grid = {place.segments, segment_steps + place.first_segment,
                         segment_fractions + place.first_segment, stages + place.first_stage};
  return grid;
}
#define FIND_GRID(item) find_grid(item, item_grid, grids, segment_steps, segment_fractions, stages)
