// What the walk over the phase grid (walk.h) is given beside a state.

// A phase grid. Each of its segments, between two break phases, has steps of equal length.
typedef struct {
  sweep_uint segments;
  TABLE sweep_uint* steps;   // [segment]
  TABLE scalar* fractions;   // [segment] what one step is of a period
  TABLE PhaseCoefs* stages;  // of the first segment, then of the next, ...
} WalkGrid;

// The box of a motion in the space of states.
typedef struct {
  real low[MODEL_STATE_COUNT], high[MODEL_STATE_COUNT];
  real made[MODEL_STATE_COUNT];  // by the magnitudes of all states in a period (walk_period)
} Extent;

// An extent is a yardstick: one step in so many does for it.
#define EXTENT_EVERY 8

SHARED_FN void extent_begin(const real* x, Extent* extent) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    extent->low[i] = extent->high[i] = x[i];
    extent->made[i] = 0;
  }
}

SHARED_FN void extent_widen(const real* x, Extent* extent) {
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    extent->low[i] = lane_min(extent->low[i], x[i]);
    extent->high[i] = lane_max(extent->high[i], x[i]);
  }
}
