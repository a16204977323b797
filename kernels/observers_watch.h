// A walk (walk.h) whose steps the observers see.

typedef struct {
  const Observers* observers;
  Moment earlier, before, middle, after;
  mask was_smooth;  // the step before this one, of the same segment
} Watcher;

// Whether the same flanks touch at both moments: then the field between them is smooth.
SHARED_FN mask watch_same_contact(const Moment* a, const Moment* b) {
#ifdef MODEL_CONTACT
  const ModelSignals* one = &a->signals;
  const ModelSignals* other = &b->signals;
  return ((one->backlash < one->deflection) == (other->backlash < other->deflection)) &
         ((one->deflection < -one->backlash) == (other->deflection < -other->backlash));
#else
  const real zero = 0;
  (void)a, (void)b;
  return zero == zero;
#endif
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
