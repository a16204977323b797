// A walk (walk.h) whose steps the observers see.

typedef struct {
  const Observers* observers;
  Moment before, after;
} Watcher;

SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                             const real* x) {
  take_moment(point, stage, x, &watcher->before);
}

SHARED_FN void watch_step(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                          scalar share, const real* x) {
  take_moment(point, stage, x, &watcher->after);
  const Step step = {&watcher->before, &watcher->after, share};
  observers_step(watcher->observers, &step);
  watcher->before = watcher->after;
}
