// The sweep kernels: a work-item advances LANES points by a round of whole periods.
//
// Build macros: REAL_BITS (32, 64), LANES (1, 2, 4, 8, 16), CONTRACT (0: no fused multiply-add),
// EVENTS (1: steps that cross a limit of the contact are corrected).
// The host writes selection.h for each study. It includes the model and the observables and defines
//   MODEL_OPTION_VALUES             the model's options, as an initialiser
//   PARAMETER_name                  where each parameter comes from: uniform[i] or swept[...]
//   OBSERVERS(CHANNEL, STEP, TANGENT, ORBIT)  CHANNEL(observable, channel, value of it),
//                                   STEP(observable), TANGENT(observable) or ORBIT(observable)
//   TANGENTS                        tangent vectors that the observers need
//   PERIOD_TOLERANCE                of the study; undefined when no observer is an ORBIT
//   POINCARE_STATES(X)              X(state) of each sampled state; undefined when there is none
//
// Device buffers are structures of arrays: state, tangents, swept, accumulators and outputs are
// [component][item], each element a `real` of LANES neighbouring points.
#include "dialect.h"
#include "selection.h"
#include "sweep_types.h"

#define LOAD_PARAMETER(name, unit, value, least, greatest, shapes_phase, meaning) \
  parameters.name = (real)(PARAMETER_##name);

// A point that has diverged carries NaN in its first state: from then on it stays out of the maps.
#define IS_DIVERGED(x) ((x)[0] != (x)[0])

SHARED_FN void load_point(uint items, uint item, TABLE scalar* uniform, TABLE real* swept,
                          ModelPoint* point) {
  const ModelOptions options = MODEL_OPTION_VALUES;
  ModelParameters parameters;
  MODEL_PARAMETERS(LOAD_PARAMETER)
  model_prepare(&parameters, options, point);
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

SHARED_FN void mark_diverged(real* x) {
  const real limit = (scalar)(SWEEP_DIVERGED_BEYOND);
  mask inside = lane_abs(x[0]) < limit;
  UNROLL
  for (int i = 1; i < MODEL_STATE_COUNT; ++i) inside = inside & (lane_abs(x[i]) < limit);
  x[0] = lane_select(inside, x[0], (real)(NAN));
}

// Loads an item's states and parameters; false when there is nothing to advance.
SHARED_FN bool take_item(uint items, uint item, TABLE scalar* uniform, TABLE real* swept,
                         __global const real* state, real* x, ModelPoint* point) {
  if (item >= items) return false;
  load_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  if (all_lanes(IS_DIVERGED(x))) return false;
  load_point(items, item, uniform, swept, point);
  return true;
}

#include "tangent.h"

// Where the phase grids of a tile lie.
#define GRID_TABLES                                                         \
  TABLE uint *item_grid, TABLE SweepGrid *grids, TABLE uint *segment_steps, \
      TABLE scalar *segment_fractions, TABLE PhaseCoefs *stages

// Advances a state by whole periods, and with it the tangent vectors, unless w is null.
SHARED_FN void advance_periods(uint periods, const ModelPoint* point, SweepGrid grid,
                               TABLE uint* segment_steps, TABLE scalar* segment_fractions,
                               TABLE PhaseCoefs* stages, real* x, real* w, real* growth) {
  for (uint period = 0; period < periods; ++period) {
    TABLE PhaseCoefs* stage = stages + grid.first_stage;
    for (uint segment = 0; segment < grid.segments; ++segment) {
      const uint steps = segment_steps[grid.first_segment + segment];
      const real h = segment_fractions[grid.first_segment + segment] * point->period;
      const bool is_last = segment + 1 == grid.segments;
      for (uint step = 0; step < steps; ++step) {
        if (w) {
          tangent_step(point, stage, h, x, w);
          if (TANGENT_IS_DUE(step, is_last && step + 1 == steps)) tangent_orthonormalize(w, growth);
        } else {
          rk4_step(point, stage, h, EVENTS, x);
        }
        stage += RK4_STAGES_PER_STEP;
      }
      stage += 1;
    }
    mark_diverged(x);
  }
}

__kernel void settle(const SweepRound round, TABLE scalar* uniform, TABLE real* swept, GRID_TABLES,
                     __global real* state) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;

  advance_periods(round.periods, &point, grids[item_grid[item]], segment_steps, segment_fractions,
                  stages, x, 0, 0);
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}

#if TANGENTS > 0
// As settle, with the tangent vectors, which turn into the directions that grow fastest.
__kernel void align(const SweepRound round, TABLE scalar* uniform, TABLE real* swept, GRID_TABLES,
                    __global real* state, __global real* tangents) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  real w[TANGENT_NUMBERS];
  real growth[TANGENT_VECTORS];
  for (int j = 0; j < TANGENTS; ++j) growth[j] = 0;
  load_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);

  advance_periods(round.periods, &point, grids[item_grid[item]], segment_steps, segment_fractions,
                  stages, x, w, growth);
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  store_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);
}
#endif

// What an observable sees of a moment.
typedef struct {
  ModelSignals signals;
  real x[MODEL_STATE_COUNT];
} Sample;

SHARED_FN void take_sample(const ModelPoint* point, TABLE PhaseCoefs* stage, const real* x,
                           Sample* sample) {
  const PhaseCoefs phase = *stage;
  model_signals(point, &phase, x, &sample->signals);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) sample->x[i] = x[i];
}

// Each observable counts its outputs from its list; some have one for each state.
#define PER_STATE MODEL_STATE_COUNT
#define COUNT_OUTPUT(suffix, unit, flags, meaning) +1
#include "observables.h"

#define CHANNEL_DECLARE(kind, channel, value) real kind##_of_##channel[kind##_accumulators];
#define CHANNEL_INIT(kind, channel, value) kind##_init(kind##_of_##channel, value(before));
#define CHANNEL_UPDATE(kind, channel, value) \
  kind##_update(kind##_of_##channel, value(before), value(after), weight);
#define CHANNEL_PERIOD(kind, channel, value) kind##_period(kind##_of_##channel);
#define CHANNEL_LOAD(kind, channel, value) \
  OBSERVER_MOVE(load_components, accumulators, kind##_accumulators, kind##_of_##channel)
#define CHANNEL_STORE(kind, channel, value) \
  OBSERVER_MOVE(store_components, accumulators, kind##_accumulators, kind##_of_##channel)
#define CHANNEL_FINISH(kind, channel, value) \
  OBSERVER_FINISH(load_components, kind, kind##_of_##channel)

#define STEP_DECLARE(kind) real kind##_sums[kind##_accumulators];
#define STEP_INIT(kind) kind##_init(kind##_sums, &before);
#define STEP_UPDATE(kind) kind##_update(kind##_sums, &before, &after, weight);
#define STEP_PERIOD(kind) kind##_period(kind##_sums);
#define STEP_LOAD(kind) \
  OBSERVER_MOVE(load_components, accumulators, kind##_accumulators, kind##_sums)
#define STEP_STORE(kind) \
  OBSERVER_MOVE(store_components, accumulators, kind##_accumulators, kind##_sums)
#define STEP_FINISH(kind) OBSERVER_FINISH(load_components, kind, kind##_sums)

#define TANGENT_DECLARE(kind) STEP_DECLARE(kind)
#define TANGENT_INIT(kind) kind##_init(kind##_sums);
#define TANGENT_UPDATE(kind)
#define TANGENT_PERIOD(kind) \
  kind##_period(kind##_sums, growth, point.period, round.recorded + period, round.record);
#define TANGENT_LOAD(kind) STEP_LOAD(kind)
#define TANGENT_STORE(kind) STEP_STORE(kind)
#define TANGENT_FINISH(kind) STEP_FINISH(kind)

#define ORBIT_DECLARE(kind) STEP_DECLARE(kind)
#define ORBIT_INIT(kind) kind##_init(kind##_sums, x);
#define ORBIT_UPDATE(kind)
#define ORBIT_PERIOD(kind) \
  kind##_period(kind##_sums, x, growth, point.period, round.recorded + period, round.record);
#define ORBIT_LOAD(kind) OBSERVER_MOVE(load_many, accumulators, kind##_accumulators, kind##_sums)
#define ORBIT_STORE(kind) OBSERVER_MOVE(store_many, accumulators, kind##_accumulators, kind##_sums)
#define ORBIT_FINISH(kind) OBSERVER_FINISH(load_many, kind, kind##_sums)

// Each observer's accumulators follow those of the one before it.
#define OBSERVER_MOVE(move, buffer, count, values) \
  move(buffer, items, item, first, count, values); \
  first += count;
#define OBSERVER_FINISH(load, kind, sums)                                      \
  {                                                                            \
    real out[kind##_outputs];                                                  \
    load(accumulators, items, item, first, kind##_accumulators, sums);         \
    kind##_finish(sums, round, out);                                           \
    store_components(outputs, items, item, first_output, kind##_outputs, out); \
    first += kind##_accumulators;                                              \
    first_output += kind##_outputs;                                            \
  }

__kernel void record(const SweepRound round, TABLE scalar* uniform, TABLE real* swept, GRID_TABLES,
                     __global real* state, __global real* tangents, __global real* accumulators,
                     __global real* series) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const SweepGrid grid = grids[item_grid[item]];

  OBSERVERS(CHANNEL_DECLARE, STEP_DECLARE, TANGENT_DECLARE, ORBIT_DECLARE)
  Sample before;
  Sample after;
  real w[TANGENT_NUMBERS];
  real growth[TANGENT_VECTORS];
  load_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);
  if (round.recorded == 0) {
    take_sample(&point, stages + grid.first_stage, x, &before);
    OBSERVERS(CHANNEL_INIT, STEP_INIT, TANGENT_INIT, ORBIT_INIT)
  } else {
    uint first = 0;
    OBSERVERS(CHANNEL_LOAD, STEP_LOAD, TANGENT_LOAD, ORBIT_LOAD)
  }

  for (uint period = 0; period < round.periods; ++period) {
    TABLE PhaseCoefs* stage = stages + grid.first_stage;
    for (int j = 0; j < TANGENTS; ++j) growth[j] = 0;
    for (uint segment = 0; segment < grid.segments; ++segment) {
      const uint steps = segment_steps[grid.first_segment + segment];
      const scalar weight = segment_fractions[grid.first_segment + segment];
      const real h = weight * point.period;
      const bool is_last = segment + 1 == grid.segments;
      take_sample(&point, stage, x, &before);
      for (uint step = 0; step < steps; ++step) {
        tangent_step(&point, stage, h, x, w);
        if (TANGENT_IS_DUE(step, is_last && step + 1 == steps)) tangent_orthonormalize(w, growth);
        stage += RK4_STAGES_PER_STEP;
        take_sample(&point, stage, x, &after);
        OBSERVERS(CHANNEL_UPDATE, STEP_UPDATE, TANGENT_UPDATE, ORBIT_UPDATE)
        before = after;
      }
      stage += 1;
    }
    OBSERVERS(CHANNEL_PERIOD, STEP_PERIOD, TANGENT_PERIOD, ORBIT_PERIOD)
    mark_diverged(x);
#ifdef POINCARE_STATES
    if (round.recorded + period < round.samples) {
      poincare_section(series, round.recorded + period, items, item, x);
    }
#endif
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  store_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);
  uint first = 0;
  OBSERVERS(CHANNEL_STORE, STEP_STORE, TANGENT_STORE, ORBIT_STORE)
}

// Turns accumulators into outputs, once all periods are recorded.
__kernel void finish(const SweepRound round, __global const real* accumulators,
                     __global real* outputs) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  if (item >= items) return;
  uint first = 0;
  uint first_output = 0;
  OBSERVERS(CHANNEL_DECLARE, STEP_DECLARE, TANGENT_DECLARE, ORBIT_DECLARE)
  OBSERVERS(CHANNEL_FINISH, STEP_FINISH, TANGENT_FINISH, ORBIT_FINISH)
}
