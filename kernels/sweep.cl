// The sweep kernels: a work-item advances LANES points by a round of whole periods.
//
// The host writes selection.h and observers.h for each study: the model with its options, and
// functions that call the observables that the study asks for by name. `gearsweep kernels STUDY`
// prints all of it.
#include "items.h"
#include "observers.h"
#include "observers_watch.h"
#include "walk.h"

// The moment at which a record begins.
SHARED_FN void see_start(const ModelPoint* point, const WalkGrid* grid, const real* x,
                         Instant* start) {
#ifdef MODEL_SURFACES
  const real zero = 0;
  const SurfaceRows rows = surface_rows(point, grid->stages, grid->fractions[0] * point->period);
  ModelPoint own = *point;
  surfaces_begin(&own, &rows, x);
  watch_instant(&own, &rows, zero, x, start);
#else
  take_moment(point, grid->stages, x, start);
#endif
}

__kernel void settle(const SweepRound round, PARAMETER_TABLES, GRID_TABLES, __global real* state) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  for (uint period = 0; period < round.periods; ++period) {
    walk_period(&point, &grid, EVENTS, 0, x, 0, 0, 0, 0);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}

#if TANGENTS > 0
// As settle, with tangent vectors: they turn into the directions that grow fastest.
__kernel void align(const SweepRound round, PARAMETER_TABLES, GRID_TABLES, __global real* state,
                    __global real* tangents) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  real w[TANGENT_NUMBERS];
  real log_stretching[TANGENT_VECTORS];
  for (int j = 0; j < TANGENTS; ++j) log_stretching[j] = 0;
  load_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);
  for (uint period = 0; period < round.periods; ++period) {
    walk_period(&point, &grid, EVENTS, WALK_TANGENTS | WALK_STRETCHINGS, x, w, log_stretching, 0,
                0);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  store_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);
}
#endif

// Advances states and tangent vectors, and shows steps and periods to the observers.
__kernel void record(const SweepRound round, PARAMETER_TABLES, GRID_TABLES, __global real* state,
                     __global real* tangents, __global real* accumulators, __global real* series) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  DECLARE_OBSERVERS(observers);
  Watcher watcher;
  watcher.observers = &observers;
  Extent extent;  // of the period
  const int beside =
      WALK_EXTENT | WALK_WATCHED | (TANGENTS > 0 ? WALK_TANGENTS | WALK_STRETCHINGS : 0);
  real w[TANGENT_NUMBERS];
  real log_stretching[TANGENT_VECTORS];
  load_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);
  watcher.series.numbers = series;
  watcher.series.samples = round.samples;
  watcher.series.items = items;
  watcher.series.item = item;
  watcher.per_record = (scalar)(1) / (scalar)(round.record);
  if (round.done == 0) {
    see_start(&point, &grid, x, &watcher.before);
    observers_init(&observers, &watcher.before);
  } else {
    observers_load(&observers, accumulators, items, item);
  }
#ifdef WATCHED_SECTIONS
  observers_sections(&observers, watcher.crossings);
#endif
#ifdef SAMPLED_AT_SECTION
  for (uint i = 0; round.done == 0 && i < round.samples * SAMPLED_AT_SECTION; ++i) {
    series[(size_t)i * items + item] = NAN;
  }
#endif
  for (uint period = 0; period < round.periods; ++period) {
    const uint number = round.done + period;
    for (int j = 0; j < TANGENTS; ++j) log_stretching[j] = 0;
    extent_begin(x, &extent);
    watcher.number = number;
    watcher.inside = 0;
    walk_period(&point, &grid, EVENTS, beside, x, w, log_stretching, &extent, &watcher);
    const Section section = {.x = x,
                             .end = &watcher.after,
                             .log_stretching = log_stretching,
                             .extent = &extent,
                             .period = point.period,
                             .number = number,
                             .record = round.record,
                             .series = number < round.samples ? series : 0,
                             .items = items,
                             .item = item};
    observers_end_period(&observers, &section);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  store_components(tangents, items, item, 0, TANGENTS * MODEL_STATE_COUNT, w);
  observers_store(&observers, accumulators, items, item);
}

// Shows the observers a whole record of a periodic orbit, but no steps. Only `length` periods are
// integrated; the others repeat their sections ([period][state][item]). log_stretchings ([tangent
// vector][item]) are known from the multipliers. Only outputs of the role verdict have a meaning
// afterwards.
__kernel void replay(const SweepRound round, PARAMETER_TABLES, GRID_TABLES, __global real* state,
                     __global const real* log_stretchings, const uint length,
                     __global real* sections, __global real* accumulators) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  DECLARE_OBSERVERS(observers);
  Instant start;
  Extent extent;
  real log_stretching[TANGENT_VECTORS];
  for (int j = 0; j < TANGENTS; ++j) log_stretching[j] = log_stretchings[(size_t)j * items + item];
  see_start(&point, &grid, x, &start);
  observers_init(&observers, &start);
  for (uint period = 0; period < round.record; ++period) {
    const uint first_component = period % length * MODEL_STATE_COUNT;
    if (period < length) {
      extent_begin(x, &extent);
      walk_period(&point, &grid, EVENTS, WALK_EXTENT, x, 0, 0, &extent, 0);
      store_components(sections, items, item, first_component, MODEL_STATE_COUNT, x);
    } else {
      load_components(sections, items, item, first_component, MODEL_STATE_COUNT, x);
    }
    const Section section = {.x = x,
                             .end = &start,
                             .log_stretching = log_stretching,
                             .extent = &extent,
                             .period = point.period,
                             .number = period,
                             .record = round.record,
                             .items = items,
                             .item = item};
    observers_end_period(&observers, &section);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  observers_store(&observers, accumulators, items, item);
}

// Turns accumulators into outputs, once all periods are recorded.
__kernel void finish(const SweepRound round, __global const real* accumulators,
                     __global real* outputs) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  if (item >= items) return;
  DECLARE_OBSERVERS(observers);
  observers_load(&observers, accumulators, items, item);
  observers_finish(&observers, round, outputs, items, item);
}
