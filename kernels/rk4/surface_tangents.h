// Tangent vectors through the surfaces of a model. One that is carried through a crossing jumps by
// (g - f) (grad(level) w)/rate, with the fields f before it and g behind it, and the rate of the
// level before it (the saltation matrix; R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of
// Non-Smooth Mechanical Systems, 2004, chapter 7). Where a state is reset it is carried by the
// reset's derivative as well.

#ifdef MODEL_SURFACES
#if TANGENTS > 0

// The tangent vectors of lanes that slide, over a part.
SHARED_FN void surface_sliding_tangents(const ModelPoint* point, const SurfacePart* part,
                                        mask where, real* w) {
  real at[MODEL_STATE_COUNT];
  real at_w[TANGENT_NUMBERS];
  real sum_w[TANGENT_NUMBERS];
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) at[i] = part->x[i];
  for (int i = 0; i < TANGENT_NUMBERS; ++i) at_w[i] = sum_w[i] = w[i];
  for (int stage = 0; stage < RK4_EVALUATIONS; ++stage) {
    const bool is_outer = stage == 0 || stage == 3;
    const PhaseAt moment = stage == 0 ? *part->start : stage == 3 ? *part->end : *part->middle;
    const real weight = part->length * (scalar)(is_outer ? 1.0 / 6.0 : 1.0 / 3.0);
    const real reach = part->length * (scalar)(stage == 2 ? 1.0 : 0.5);
    Sliding sliding;
    real dx[MODEL_STATE_COUNT];
    sliding_find(point, &moment, at, &sliding);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) dx[i] = sliding.base[i];
    sliding_add(&sliding, sliding.share, dx);
    for (int j = 0; j < TANGENTS; ++j) {
      const int first = j * MODEL_STATE_COUNT;
      real out[MODEL_STATE_COUNT];
      sliding_tangent(point, &moment, at, &sliding, dx, at_w + first, out);
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
        sum_w[first + i] = sum_w[first + i] + weight * out[i];
        at_w[first + i] = w[first + i] + reach * out[i];
      }
    }
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) at[i] = part->x[i] + reach * dx[i];
  }
  for (int i = 0; i < TANGENT_NUMBERS; ++i) w[i] = lane_select(where, sum_w[i], w[i]);
}

// Unit vectors across the surfaces that the motion rests against, each across the ones before, too;
// 0 of the others, and of one that says nothing new.
SHARED_FN void surface_directions(const ModelPoint* point, const PhaseAt* moment, const real* x,
                                  real directions[MODEL_SURFACES][MODEL_STATE_COUNT]) {
  const real zero = 0;
  const real one = 1;
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    real* own = directions[k];
    real whole = 0;
    real left = 0;
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) own[i] = 0;
    if (!MODEL_RESETS(k)) continue;
    (void)surface_normal(point, moment, x, k, own);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) whole = whole + own[i] * own[i];
    UNROLL
    for (int j = 0; j < k; ++j) {
      real both = 0;
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) both = both + own[i] * directions[j][i];
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) own[i] = own[i] - both * directions[j][i];
    }
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) left = left + own[i] * own[i];
    const mask counts =
        point->sides.slides[k] & (SURFACE_ROUNDING * SURFACE_ROUNDING * whole < left);
    const real scale = lane_select(counts, one / lane_sqrt(left), zero);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) own[i] = lane_select(counts, scale * own[i], zero);
  }
}

// Takes from tangent vectors what they have across the surfaces that the motion stays at. A
// neighbour that lies off a surface by d comes to it in a time of order d, and from either side to
// the same place: w - turn (grad(held) w)/gain. What rests on a surface has no other level either;
// how much of it there is left when impacts end falls with the flights, so that the way back does
// not matter. What is left of a vector that is lost whole is rounding.
SHARED_FN void surface_settle_tangents(const ModelPoint* point, const PhaseAt* moment,
                                       const real* x, mask where, real* w) {
  const real zero = 0;
  real directions[MODEL_SURFACES][MODEL_STATE_COUNT];
  Sliding sliding;
  sliding_find(point, moment, x, &sliding);
  surface_directions(point, moment, x, directions);
  for (int j = 0; j < TANGENTS; ++j) {
    real* own = w + j * MODEL_STATE_COUNT;
    real settled[MODEL_STATE_COUNT];
    real held[MODEL_SURFACES];
    const real size = tangent_size(own);
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) settled[i] = own[i];
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      if (!MODEL_RESETS(k)) continue;
      real across = 0;
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) across = across + directions[k][i] * settled[i];
      for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
        settled[i] = settled[i] - across * directions[k][i];
      }
    }
    model_held_along(point, moment, x, settled, held);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) held[k] = -held[k];
    sliding_solve(point, &sliding, 0, held);
    sliding_keep_finite(held);
    sliding_add(&sliding, held, settled);
    const mask is_lost = tangent_size(settled) < TANGENT_LOST * size;
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      own[i] = lane_select(where, lane_select(is_lost, zero, settled[i]), own[i]);
    }
  }
}

// Advances the tangent vectors of these lanes over a part.
SHARED_FN void surface_tangents(const ModelPoint* point, const SurfacePart* part, int beside,
                                const ModelLinear* linear, const Crossings* crossings, mask where,
                                real* w) {
  const mask slides = where & sliding_any(point);
  if (!all_lanes(!slides)) surface_settle_tangents(point, part->start, part->x, slides, w);
  for (int j = 0; j < TANGENTS; ++j) {
    real row[MODEL_STATE_COUNT];
    real* own = w + j * MODEL_STATE_COUNT;
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) row[i] = own[i];
    rk4_tangent_step(point, part->length, beside, linear, crossings, row);
    UNROLL
    for (int i = 0; i < MODEL_STATE_COUNT; ++i) {
      own[i] = lane_select(where & !slides, row[i], own[i]);
    }
  }
  if (!all_lanes(!slides)) surface_sliding_tangents(point, part, slides, w);
}

// How much earlier each tangent vector comes to the surface that is crossed.
SHARED_FN void surface_delays(const ModelPoint* point, const PhaseAt* moment, const real* x,
                              const real* rates, const mask* hit, const real* w, real* delays) {
  const real zero = 0;
  for (int j = 0; j < TANGENTS; ++j) {
    real added[MODEL_SURFACES];
    real delay = 0;
    model_level_along(point, moment, x, w + j * MODEL_STATE_COUNT, added);
    UNROLL
    for (int k = 0; k < MODEL_SURFACES; ++k) {
      delay = lane_select(hit[k] & (rates[k] != zero), added[k] / rates[k], delay);
    }
    delays[j] = delay;
  }
}

#endif
#endif
