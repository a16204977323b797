// The kernels that look for the periodic orbit that a point is settling on.
#include "dialect.h"
#include "selection.h"

// The derivative of a return map has one tangent vector for each state. A number, which is compared
// with 0 where the program is read.
#undef TANGENTS
#define TANGENTS STATES
#include "items.h"
#include "unwatched.h"
#include "walk.h"

// The sections of an item are its states at the beginning of an approach and after each period of
// it: [period][state]. All sections of an item are contiguous, so that a CPU finds them in its
// cache.
#define SECTION_NUMBERS ((ORBIT_LONGEST + 1) * MODEL_STATE_COUNT)

// The distance from x to the section that lies `ago` periods before the last, in units of the
// ranges.
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

// Advances each lane by its own number of periods, lengths ([item]), in one or more rounds, and
// keeps their sections, the number `first` and those behind it. Lanes that are done go on beside
// the others: what they leave after their number is not looked at. All but the last of the periods
// of an approach are followed, too; its last section has the number ORBIT_LONGEST.
__kernel void follow(const SweepRound round, PARAMETER_TABLES, GRID_TABLES, __global real* state,
                     TABLE real* lengths, const uint first, __global real* sections) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  __global real* own = sections + (size_t)item * SECTION_NUMBERS;
  if (round.done == 0) store_section(own, first, x);
  for (uint period = round.done; period < round.done + round.periods; ++period) {
    if (all_lanes((scalar)(period) >= lengths[item])) break;
    walk_period(&point, &grid, EVENTS, 0, x, 0, 0, 0, 0);
    store_section(own, first + period + 1, x);
  }
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}

// The last period of an approach, which also measures the motion. ranges ([state][item]) are the
// units of distances between states: how far each state moves in the period, but enough that
// `tolerance` times the unit stays above rounding.
__kernel void measure(const SweepRound round, PARAMETER_TABLES, GRID_TABLES, __global real* state,
                      __global real* sections, const scalar tolerance, __global real* ranges) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  Extent extent;
  real own[MODEL_STATE_COUNT];
  real shared[MODEL_STATE_COUNT];
  extent_begin(x, &extent);
  walk_period(&point, &grid, EVENTS, WALK_EXTENT, x, 0, 0, &extent, 0);
  extent_ranges(&extent, tolerance, own);
  share_ranges(own, shared);
  store_components(ranges, items, item, 0, MODEL_STATE_COUNT, shared);
  store_section(sections + (size_t)item * SECTION_NUMBERS, ORBIT_LONGEST, x);
  store_components(state, items, item, 0, MODEL_STATE_COUNT, x);
}

// At most so many differences of returns are combined. Older returns say less about the orbit.
#define EXTRAPOLATED 4
// A difference is made orthogonal to the others. Where this shrinks its square below this share,
// rounding is all that is left, and the difference is not used.
#define EXTRAPOLATION_NOISE ((scalar)(REAL_BITS == 64 ? 1e-16 : 1e-6))

// Extrapolates the sequence of returns after `lag`, 2 lag, ... periods, of which x is the last, to
// its limit. The guess is the affine combination of the returns that the next return would move
// least, were the map affine (reduced rank extrapolation; Smith, Ford, Sidi, SIAM Review 29 (1987)
// 199-233). It is found by the modified Gram-Schmidt method. periods: of the approach.
SHARED_FN void extrapolate_returns(__global const real* sections, uint periods, uint lag,
                                   const real* x, const real* ranges, real* guess) {
  const real zero = 0;
  const real one = 1;
  const int count = min((int)(periods / lag) - 1, EXTRAPOLATED);
  real earlier[MODEL_STATE_COUNT];
  real later[MODEL_STATE_COUNT];               // both as their distance from x
  real moved[MODEL_STATE_COUNT];               // by the last return
  real rest[MODEL_STATE_COUNT];                // how far a return would move the guess
  real way_out[MODEL_STATE_COUNT];             // from x to the guess
  real bend[EXTRAPOLATED][MODEL_STATE_COUNT];  // second differences, made orthonormal
  real way[EXTRAPOLATED][MODEL_STATE_COUNT];   // the same combinations of the returns themselves
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

// After an approach of so many periods: finds a return and guesses the orbit. A return after n
// periods is one where the state now and the state n periods ago differ by at most near / n^2, in
// units of the ranges; the smallest n counts. The limit has n^2, because motion on a torus returns
// to within about 1 / n^2 of its size for some n without being periodic (Dirichlet's theorem).
// lengths is [item]: on entry the sum of 2^(n - 1) over the n that are excluded; on exit n, or 0
// where there is no return. guesses is [state][item]. This is a kernel of its own, since as the end
// of `measure` it would make that one slower (PoCL).
__kernel void extrapolate(const SweepRound round, __global const real* state,
                          __global const real* sections, __global const real* ranges,
                          const scalar near, const uint periods, __global real* lengths,
                          __global real* guesses) {
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
  real smallest = 0;
  real excluded = lengths[item];
  for (uint n = 1; n <= periods; ++n) {
    const real others = floor(excluded / two);
    const mask is_open = others * two == excluded;
    excluded = others;
    real apart[MODEL_STATE_COUNT];
    load_return(own, n, x, shared, apart);
    const mask is_near = max_size(apart) <= near / (scalar)(n * n);
    const mask is_min = is_open & (smallest == zero) & is_near & !IS_DIVERGED(x);
    if (all_lanes(!is_min)) continue;
    real orbit[MODEL_STATE_COUNT];
    extrapolate_returns(own, periods, n, x, shared, orbit);
    smallest = lane_select(is_min, (real)(n), smallest);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) guess[i] = lane_select(is_min, orbit[i], guess[i]);
  }
  lengths[item] = smallest;
  store_components(guesses, items, item, 0, MODEL_STATE_COUNT, guess);
}

SHARED_FN void store_where(mask where, __global real* buffer, uint items, uint item, int count,
                           const real* values) {
  for (int i = 0; i < count; ++i) {
    __global real* number = buffer + (size_t)i * items + item;
    *number = lane_select(where, values[i], *number);
  }
}

// Advances each lane by its own number of periods, lengths ([item]), in one or more rounds, and the
// derivative of this map ([column][row][item]), which begins as the identity.
__kernel void return_map_linearized(const SweepRound round, PARAMETER_TABLES, GRID_TABLES,
                                    __global real* state, TABLE real* lengths,
                                    __global real* derivative) {
  const uint items = round.items;
  const uint item = get_global_id(0);
  real x[MODEL_STATE_COUNT];
  ModelPoint point;
  if (!TAKE_ITEM(x, &point)) return;
  const WalkGrid grid = FIND_GRID(item);
  real w[TANGENT_NUMBERS];
  for (uint period = round.done; period < round.done + round.periods; ++period) {
    const mask is_under_way = (scalar)(period) < lengths[item];
    if (all_lanes(!is_under_way)) return;
    load_many(derivative, items, item, 0, TANGENT_NUMBERS, w);
    walk_period(&point, &grid, EVENTS, WALK_TANGENTS, x, w, 0, 0, 0);
    store_where(is_under_way, state, items, item, MODEL_STATE_COUNT, x);
    store_where(is_under_way, derivative, items, item, TANGENT_NUMBERS, w);
  }
}
