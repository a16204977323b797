// A walk (walk.h) whose steps the observers see.

typedef struct {
  const Observers* observers;
  Instant earlier, before, middle, after;
  mask was_smooth;  // the step before this one, of the same segment
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

SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                             const real* x) {
  const real zero = 0;
  take_moment(point, stage, x, &watcher->before);
  watcher->earlier = watcher->before;
  watcher->was_smooth = zero != zero;
}

SHARED_FN void watch_step(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                          scalar share, const real* middle, const real* x) {
  const real zero = 0;
  const real sixth = (scalar)(1.0 / 6.0);
  take_moment(point, stage - 1, middle, &watcher->middle);
  take_moment(point, stage, x, &watcher->after);
  const mask smooth = watch_same_contact(&watcher->before, &watcher->middle) &
                      watch_same_contact(&watcher->middle, &watcher->after);
  const Step step = {&watcher->earlier,
                     &watcher->before,
                     &watcher->middle,
                     &watcher->after,
                     share,
                     smooth,
                     lane_select(watcher->was_smooth, sixth, zero)};
  observers_step(watcher->observers, &step);
  watcher->earlier = watcher->middle;
  watcher->before = watcher->after;
  watcher->was_smooth = smooth;
}
