// The kernels that look for the periodic orbit that a point is settling on.
#include "dialect.h"
#include "selection.h"

// A return map's derivative takes a tangent vector along each state.
#undef TANGENTS
#define TANGENTS MODEL_STATE_COUNT
#include "items.h"
#include "unwatched.h"
#include "walk.h"

// An item's sections are its states at the beginning of an approach and after each of its periods:
// [period][state]. They stand together, so that each item's stay near in a CPU's memory.
#define SECTION_NUMBERS ((ORBIT_LONGEST + 1) * MODEL_STATE_COUNT)

// The distance of the section so many periods before the last from x, relative to the ranges.
SHARED_FN void load_return(__global const real* sections, uint ago, const real* x,
                           const real* ranges, real* distance) {
  real section[MODEL_STATE_COUNT];
  load_components(sections, 1, 0, (ORBIT_LONGEST - ago) * MODEL_STATE_COUNT, MODEL_STATE_COUNT,
                  section);
  relative_difference(section, x, ranges, distance);
}

SHARED_FN void store_section(__global real* sections, uint number, const real* x) {
  store_components(sections, 1, 0, number * MODEL_STATE_COUNT, MODEL_STATE_COUNT, x);
}

// Settles by some of the ORBIT_LONGEST periods of an approach in one or more rounds; sections is
// [item][period][state].
__kernel void approach(const SweepRound round, TABLE scalar* uniform, TABLE real* swept,
                       GRID_TABLES, __global real* state, __global real* sections) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  __global real* own = sections + (size_t)item * SECTION_NUMBERS;
  if (round.recorded == 0) store_section(own, 0, x);
  for (uint period = 0; period < round.periods; ++period) {
    walk_period(&point, &grid, EVENTS, x, 0, 0, 0, 0);
    store_section(own, round.recorded + period + 1, x);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}

// The last period of an approach. ranges is [state][item]: what distances between the point's
// states are relative to, when `tolerance` times that must not drown in rounding.
__kernel void measure(const SweepRound round, TABLE scalar* uniform, TABLE real* swept, GRID_TABLES,
                      __global real* state, __global real* sections, const scalar tolerance,
                      __global real* ranges) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  Extent extent;
  real own[MODEL_STATE_COUNT];
  real shared[MODEL_STATE_COUNT];
  extent_begin(x, &extent);
  walk_period(&point, &grid, EVENTS, x, 0, 0, &extent, 0);
  extent_ranges(&extent, tolerance, own);
  share_ranges(own, shared);
  store_components(ranges, items, item, 0, MODEL_STATE_COUNT, shared);
  store_section(sections + (size_t)item * SECTION_NUMBERS, ORBIT_LONGEST, x);
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}

// Differences of returns that are combined at most. Older ones know less of the orbit.
#define EXTRAPOLATED 4
// What is left of a difference when its share in the others is taken out drowns in rounding when
// its square is below this, relative to what it was.
#define EXTRAPOLATION_NOISE ((scalar)(REAL_BITS == 64 ? 1e-16 : 1e-6))

// Where the returns after `lag`, 2 lag, ... periods, of which x is the last, lead to: that of their
// affine combinations which a return would move least, were the map affine (reduced rank
// extrapolation; Smith, Ford, Sidi, SIAM Review 29 (1987) 199-233), by the modified Gram-Schmidt
// method.
SHARED_FN void extrapolate_returns(__global const real* sections, uint lag, const real* x,
                                   const real* ranges, real* guess) {
  const real zero = 0;
  const real one = 1;
  const int count = min((int)(ORBIT_LONGEST / lag) - 1, EXTRAPOLATED);
  real earlier[MODEL_STATE_COUNT];
  real later[MODEL_STATE_COUNT];               // both as their distance from x
  real moved[MODEL_STATE_COUNT];               // by the last return
  real rest[MODEL_STATE_COUNT];                // how far a return would move the guess
  real way_out[MODEL_STATE_COUNT];             // from x to the guess
  real bend[EXTRAPOLATED][MODEL_STATE_COUNT];  // orthonormal: what takes a share of the rest away
  real way[EXTRAPOLATED][MODEL_STATE_COUNT];   // and where the guess goes for it
  load_return(sections, lag, x, ranges, later);
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
    way_out[i] = 0;
    moved[i] = rest[i] = -later[i];
  }
  for (int j = 0; j < count; ++j) {
    real squares = 0;
    real left = 0;
    real share = 0;
    load_return(sections, (j + 2) * lag, x, ranges, earlier);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      bend[j][i] = (later[i] - earlier[i]) - moved[i];
      way[j][i] = later[i];
      squares = squares + bend[j][i] * bend[j][i];
      later[i] = earlier[i];
    }
    for (int k = 0; k < j; ++k) {
      real common = 0;
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) common = common + bend[k][i] * bend[j][i];
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
        bend[j][i] = bend[j][i] - common * bend[k][i];
        way[j][i] = way[j][i] - common * way[k][i];
      }
    }
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) left = left + bend[j][i] * bend[j][i];
    const real scale =
        lane_select(EXTRAPOLATION_NOISE * squares < left, one / lane_sqrt(left), zero);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      bend[j][i] = bend[j][i] * scale;
      way[j][i] = way[j][i] * scale;
      share = share + bend[j][i] * rest[i];
    }
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      rest[i] = rest[i] - share * bend[j][i];
      way_out[i] = way_out[i] - share * way[j][i];
    }
  }
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) guess[i] = x[i] + ranges[i] * way_out[i];
}

// After an approach: the least number of periods, n, before which the state was within near / n^2
// (relative to the motion's ranges) of where it is now, and a guess at the orbit that comes back
// after n periods ([state][item]). Motion on a torus comes back to within about 1 / n^2 of its size
// for some n by itself (Dirichlet's theorem). lengths is [item]: first the sum of 2^(n - 1) over
// those n that are out of the question; then n, or 0 where there is none. A kernel of its own,
// since at the end of the other it would make that one slower (PoCL).
__kernel void extrapolate(const SweepRound round, __global const real* state,
                          __global const real* sections, __global const real* ranges,
                          const scalar near, __global real* lengths, __global real* guesses) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  if (item >= items) return;
  const real zero = 0;
  const real two = 2;
  __global const real* own = sections + (size_t)item * SECTION_NUMBERS;
  real x[MODEL_STATE_COUNT];
  real guess[MODEL_STATE_COUNT];
  real shared[MODEL_STATE_COUNT];
  load_components(state, items, item, 0, MODEL_STATE_COUNT, x);
  load_components(ranges, items, item, 0, MODEL_STATE_COUNT, shared);
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) guess[i] = x[i];
  real least = 0;
  real excluded = lengths[item];
  for (uint n = 1; n <= ORBIT_LONGEST; ++n) {
    const real others = floor(excluded / two);
    const mask is_open = others * two == excluded;
    excluded = others;
    real apart[MODEL_STATE_COUNT];
    load_return(own, n, x, shared, apart);
    const mask is_near = greatest_size(apart) <= near / (scalar)(n * n);
    const mask is_least = is_open & (least == zero) & is_near & !IS_DIVERGED(x);
    if (all_lanes(!is_least)) continue;
    real orbit[MODEL_STATE_COUNT];
    extrapolate_returns(own, n, x, shared, orbit);
    least = lane_select(is_least, (real)(n), least);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i)
      guess[i] = lane_select(is_least, orbit[i], guess[i]);
  }
  lengths[item] = least;
  store_components(guesses, items, item, 0, MODEL_STATE_COUNT, guess);
}

SHARED_FN void store_where(mask where, __global real* buffer, uint items, uint item, int count,
                           const real* values) {
  for (int i = 0; i < count; ++i) {
    __global real* number = buffer + (size_t)i * items + item;
    *number = lane_select(where, values[i], *number);
  }
}

// Goes on to the state after as many periods as lengths says ([item], each lane its own), in one or
// more rounds.
__kernel void return_map(const SweepRound round, TABLE scalar* uniform, TABLE real* swept,
                         GRID_TABLES, __global real* state, TABLE real* lengths) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  for (uint period = round.recorded; period < round.recorded + round.periods; ++period) {
    const mask is_under_way = (scalar)(period) < lengths[item];
    if (all_lanes(!is_under_way)) return;
    walk_period(&point, &grid, EVENTS, x, 0, 0, 0, 0);
    store_where(is_under_way, state, items, item, MODEL_STATE_COUNT, x);
  }
}

// The same with the derivative of this map, which is [column][row][item] and begins as the
// identity.
__kernel void return_map_linearized(const SweepRound round, TABLE scalar* uniform,
                                    TABLE real* swept, GRID_TABLES, __global real* state,
                                    TABLE real* lengths, __global real* derivative) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!take_item(items, item, uniform, swept, state, x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  real w[TANGENT_NUMBERS];
  for (uint period = round.recorded; period < round.recorded + round.periods; ++period) {
    const mask is_under_way = (scalar)(period) < lengths[item];
    if (all_lanes(!is_under_way)) return;
    load_many(derivative, items, item, 0, TANGENT_NUMBERS, w);
    walk_period(&point, &grid, EVENTS, x, w, 0, 0, 0);
    store_where(is_under_way, state, items, item, MODEL_STATE_COUNT, x);
    store_where(is_under_way, derivative, items, item, TANGENT_NUMBERS, w);
  }
}
