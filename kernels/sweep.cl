// The sweep kernels: a work-item advances LANES points by a round of whole periods.
//
// The host writes selection.h for each study. Beside what items.h names it defines
//   OBSERVERS(CHANNEL, STEP, TANGENT, ORBIT)  CHANNEL(observable, channel, value of it),
//                                   STEP(observable), TANGENT(observable) or ORBIT(observable)
//   TANGENTS                        tangent vectors that the observers need
//   PERIOD_TOLERANCE                of the study; undefined when no observer is an ORBIT
//   WATCHES_SECTIONS                1 when an observer is one
//   POINCARE_STATES(X)              X(state) of each sampled state; undefined when there is none
#include "items.h"

__kernel void settle(const SweepRound round, TABLE scalar* uniform, TABLE real* swept, GRID_TABLES,
                     __global real* state) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;

  advance_periods(round.periods, &point, grids[item_grid[item]], segment_steps, segment_fractions,
                  stages, x, 0, 0, 0);
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
                  stages, x, w, growth, 0);
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
#define ORBIT_PERIOD(kind)                                                              \
  kind##_period(kind##_sums, x, growth, &extent, point.period, round.recorded + period, \
                round.record);
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
  Extent extent;  // of the period
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
    extent_begin(x, &extent);
    for (uint segment = 0; segment < grid.segments; ++segment) {
      const uint steps = segment_steps[grid.first_segment + segment];
      const scalar weight = segment_fractions[grid.first_segment + segment];
      const real h = weight * point.period;
      const bool is_last = segment + 1 == grid.segments;
      take_sample(&point, stage, x, &before);
      for (uint step = 0; step < steps; ++step) {
        tangent_step(&point, stage, h, x, w);
        if (TANGENT_IS_DUE(step, is_last && step + 1 == steps)) tangent_orthonormalize(w, growth);
        if (WATCHES_SECTIONS && step % EXTENT_EVERY == 0) extent_widen(x, &extent);
        stage += RK4_STAGES_PER_STEP;
        take_sample(&point, stage, x, &after);
        OBSERVERS(CHANNEL_UPDATE, STEP_UPDATE, TANGENT_UPDATE, ORBIT_UPDATE)
        before = after;
      }
      stage += 1;
    }
    end_period(x);
    OBSERVERS(CHANNEL_PERIOD, STEP_PERIOD, TANGENT_PERIOD, ORBIT_PERIOD)
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

#define CHANNEL_NONE(kind, channel, value)
#define STEP_NONE(kind)

// The record of a periodic orbit, of which `length` periods are integrated and the rest follow from
// them: what the observers of tangents and orbits see of it. sections is [period][state][item],
// growths [tangent vector][item], the logarithm of how far each grows in a period. The outputs of
// all other observers mean nothing after it.
__kernel void replay(const SweepRound round, TABLE scalar* uniform, TABLE real* swept, GRID_TABLES,
                     __global real* state, __global const real* growths, const uint length,
                     __global real* sections, __global real* accumulators) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const SweepGrid grid = grids[item_grid[item]];

  OBSERVERS(CHANNEL_DECLARE, STEP_DECLARE, TANGENT_DECLARE, ORBIT_DECLARE)
  real growth[TANGENT_VECTORS];
  Extent extent;
  extent_begin(x, &extent);
  for (int j = 0; j < TANGENTS; ++j) growth[j] = growths[(size_t)j * items + item];
  OBSERVERS(CHANNEL_NONE, STEP_NONE, TANGENT_INIT, ORBIT_INIT)
  for (uint period = 0; period < round.record; ++period) {
    const uint first_component = period % length * MODEL_STATE_COUNT;
    if (period < length) {
      advance_periods(1, &point, grid, segment_steps, segment_fractions, stages, x, 0, 0, &extent);
      store_components(sections, items, item, first_component, MODEL_STATE_COUNT, x);
    } else {
      load_components(sections, items, item, first_component, MODEL_STATE_COUNT, x);
    }
    OBSERVERS(CHANNEL_NONE, STEP_NONE, TANGENT_PERIOD, ORBIT_PERIOD)
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
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
