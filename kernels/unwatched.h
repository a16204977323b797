// A walk (walk.h) whose steps nobody watches.

typedef struct {
  int nothing;  // a struct must have a member
} Watcher;

SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                             const real* x) {
  (void)watcher, (void)point, (void)stage, (void)x;
}

SHARED_FN void watch_step(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                          scalar share, const real* middle, const real* x) {
  (void)watcher, (void)point, (void)stage, (void)share, (void)middle, (void)x;
}
