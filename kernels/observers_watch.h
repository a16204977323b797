// A walk (walk.h) whose steps the observers see.

#include "section_crossing.h"
#ifndef WATCHED_SECTIONS
#define WATCHED_SECTION_COUNT 1  // an array must have a member
#endif

typedef struct {
  const Observers* observers;
  Instant earlier, before, middle, after;
  uint number;        // of the period, in the record
  scalar per_record;  // 1 over the number of its periods
  Share inside;       // the period: where `before` lies
  mask was_smooth;    // the step before this one, of the same segment
  SectionCrossing crossings[WATCHED_SECTION_COUNT];
  Series series;
} Watcher;

// Whether the same flanks of one contact touch at two moments.
SHARED_FN mask watch_same_flanks(real deflection, real backlash, real later_deflection,
                                 real later_backlash, bool is_one_sided) {
  const mask drive = (backlash < deflection) == (later_backlash < later_deflection);
  if (is_one_sided) return drive;
  return drive & ((deflection < -backlash) == (later_deflection < -later_backlash));
}

#define WATCH_SAME_FLANKS(contact, deflection, backlash)                                          \
  same =                                                                                          \
      same & watch_same_flanks(a->signals.deflection, a->signals.backlash, b->signals.deflection, \
                               b->signals.backlash, MODEL_ONE_SIDED(contact));

// Whether the same flanks touch at both moments: then the field between them is smooth. A model
// that bends inside its steps (MODEL_ROUGH) says of none that it is.
SHARED_FN mask watch_same_contact(const Instant* a, const Instant* b) {
  const real zero = 0;
#ifdef MODEL_ROUGH
  mask same = zero != zero;
#else
  mask same = zero == zero;
#endif
#ifdef MODEL_CONTACT
  MODEL_CONTACT_SIGNALS(WATCH_SAME_FLANKS)
#else
  (void)a, (void)b;
#endif
  return same;
}

// What counts once so far behind `before`.
SHARED_FN Share watch_once(const Watcher* watcher, Share behind) {
  const Share place = (scalar)(watcher->number) + (watcher->inside + behind);
  return window_weight(watcher->per_record * place);
}

// Shows the observers the part from `before` to `after`, which the watcher has, and takes the end
// for the next part's start.
SHARED_FN void watch_seen(Watcher* watcher, Share share, mask stays) {
  const real zero = 0;
  const real sixth = (scalar)(1.0 / 6.0);
  const Share once = watch_once(watcher, (scalar)(0.5) * share);
  const mask smooth = watch_same_contact(&watcher->before, &watcher->middle) &
                      watch_same_contact(&watcher->middle, &watcher->after);
  const Step step = {&watcher->earlier,
                     &watcher->before,
                     &watcher->middle,
                     &watcher->after,
                     share,
                     once * share,
                     once,
                     smooth,
                     stays,
                     lane_select(watcher->was_smooth, sixth, zero),
                     watcher->crossings,
                     &watcher->series};
  observers_step(watcher->observers, &step);
  watcher->inside = watcher->inside + share;
  watcher->earlier = watcher->middle;
  watcher->before = watcher->after;
  watcher->was_smooth = smooth;
}

#include "rk4/surface_rest.h"

#ifdef MODEL_SURFACES
// At a share of a step. Where the motion slides, signals have the sides that its field mixes.
SHARED_FN void watch_instant(const ModelPoint* point, const SurfaceRows* rows, real share,
                             const real* x, Instant* instant) {
  ModelPoint seen = *point;
  PhaseAt moment;
  surface_moment(rows, share, &moment);
  surface_show_at(point, &moment, x, seen.sides.side);
  model_signals(&seen, &moment, x, &instant->signals);
  UNROLL
  for (int i = 0; i < MODEL_STATE_COUNT; ++i) instant->x[i] = x[i];
#ifdef ORDER_COUNT
  real weights[3];
  surface_weights(share, weights);
  for (int k = 0; k < ORDER_COUNT; ++k) {
    instant->orders.cosine[k] = 0;
    instant->orders.sine[k] = 0;
    for (int i = 0; i < 3; ++i) {
      instant->orders.cosine[k] += weights[i] * rows->stage[i].orders.cosine[k];
      instant->orders.sine[k] += weights[i] * rows->stage[i].orders.sine[k];
    }
  }
#endif
}

// out = yes where that holds.
SHARED_FN void watch_select(mask where, const Instant* yes, Instant* out) {
  const real* from = (const real*)yes;
  real* to = (real*)out;
  for (int i = 0; i < (int)(sizeof(Instant) / sizeof(real)); ++i) {
    to[i] = lane_select(where, from[i], to[i]);
  }
}

SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, const SurfaceRows* rows,
                             const real* x) {
  const real zero = 0;
  watch_instant(point, rows, zero, x, &watcher->before);
  watcher->earlier = watcher->before;
  watcher->was_smooth = zero != zero;
}

// In the other lanes nothing moves: their part has no length. One that ends where it begins shows
// nothing, either.
SHARED_FN void watch_part(Watcher* watcher, const ModelPoint* point, const SurfacePart* part,
                          mask moves) {
  const real zero = 0;
  const real one = 1;
  const real one_half = (scalar)(0.5);
  const mask where = moves & (part->from < *part->to);
  real inside[MODEL_STATE_COUNT];
  Instant middle;
  Instant after;
  const real halfway = one_half * (part->from + *part->to);
  surface_inside(part, one_half, inside);
  if (!all_lanes(!sliding_any(point))) {
    PhaseAt moment;
    surface_moment(part->rows, halfway, &moment);
    surface_return(point, &moment, part->rows->h, where, inside);
  }
  watch_instant(point, part->rows, halfway, inside, &middle);
  watch_instant(point, part->rows, *part->to, part->next, &after);
  watcher->middle = watcher->before;
  watcher->after = watcher->before;
  watch_select(where, &middle, &watcher->middle);
  watch_select(where, &after, &watcher->after);
  // Only a whole step has one of the same length before it.
  const mask is_whole = where & (part->from == zero) & (*part->to == one);
  const mask was_smooth = watcher->was_smooth;
  Instant earlier = watcher->earlier;
  watcher->was_smooth = was_smooth & is_whole;
#ifdef WATCHED_SECTIONS
  const real length = lane_select(where, part->length, zero);
  if (sections_find(&watcher->before, &watcher->middle, &watcher->after, length, sliding_any(point),
                    watcher->crossings)) {
    sections_take(length, watcher->before.x, watcher->after.x, part->slopes->first,
                  part->slopes->last, watcher->crossings);
  }
#endif
  watch_seen(watcher, lane_select(where, (*part->to - part->from) * part->share, zero),
             sliding_any(point));
  watcher->was_smooth = lane_select(where, watcher->was_smooth & is_whole, was_smooth);
  watch_select(!where, &earlier, &watcher->earlier);
}

// Whether a motion stays at the surfaces that it has come to slide along.
SHARED_FN mask watch_holds(const ModelPoint* point, const SurfaceRows* rows, real share,
                           const real* x) {
  const real zero = 0;
  mask holds = zero == zero;
  if (all_lanes(!sliding_any(point))) return holds;
  PhaseAt moment;
  Sliding sliding;
  surface_moment(rows, share, &moment);
  sliding_find(point, &moment, x, &sliding);
  UNROLL
  for (int k = 0; k < MODEL_SURFACES; ++k) {
    holds = holds & (!point->sides.slides[k] | !surface_is_out(k, sliding.share[k]));
  }
  return holds;
}

SHARED_FN void watch_side(Watcher* watcher, const ModelPoint* point, const SurfaceRows* rows,
                          real share, mask where, const SurfaceMet* met, const real* x) {
  const real zero = 0;
  Instant instant;
#ifdef WATCHED_SURFACES
  observers_meet(watcher->observers, where, met, watch_once(watcher, zero));
#else
  (void)met, (void)zero;
#endif
  watch_instant(point, rows, share, x, &instant);
  // What does not hold it at its surfaces shows nothing: it leaves them at once.
  watch_select(where & watch_holds(point, rows, share, x), &instant, &watcher->before);
  watcher->was_smooth = watcher->was_smooth & !where;
}

SHARED_FN void watch_step_end(Watcher* watcher, const real* x) {}

#else

SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                             const real* x) {
  const real zero = 0;
  take_moment(point, stage, x, &watcher->before);
  watcher->earlier = watcher->before;
  watcher->was_smooth = zero != zero;
}

SHARED_FN void watch_step(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                          scalar share, const real* middle, const real* x) {
  take_moment(point, stage - 1, middle, &watcher->middle);
  take_moment(point, stage, x, &watcher->after);
#ifdef WATCHED_SECTIONS
  const real length = share * point->period;
  const mask slides = length != length;
  if (sections_find(&watcher->before, &watcher->middle, &watcher->after, length, slides,
                    watcher->crossings)) {
    const PhaseCoefs start = stage[-RK4_STAGES_PER_STEP];
    const PhaseCoefs end = stage[0];
    const PhaseAt start_phase = phase_at(&start);
    const PhaseAt end_phase = phase_at(&end);
    real first[MODEL_STATE_COUNT];
    real last[MODEL_STATE_COUNT];
    ContactSeen seen;
    rk4_slope(point, &start_phase, watcher->before.x, &seen, first);
    rk4_slope(point, &end_phase, watcher->after.x, &seen, last);
    sections_take(length, watcher->before.x, watcher->after.x, first, last, watcher->crossings);
  }
#endif
  watch_seen(watcher, share, x[0] != x[0]);
}

#endif
