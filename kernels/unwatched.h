// A walk (walk.h) whose steps nobody watches.

typedef struct {
  int nothing;  // a struct must have a member
} Watcher;

#include "rk4/surface_part.h"

#ifdef MODEL_SURFACES
SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, const SurfaceRows* rows,
                             const real* x) {
  (void)watcher, (void)point, (void)rows, (void)x;
}

SHARED_FN void watch_part(Watcher* watcher, const ModelPoint* point, const SurfacePart* part,
                          mask where) {
  (void)watcher, (void)point, (void)part, (void)where;
}

SHARED_FN void watch_side(Watcher* watcher, const ModelPoint* point, const SurfaceRows* rows,
                          real share, mask where, const SurfaceMet* met, const real* x) {
  (void)watcher, (void)point, (void)rows, (void)share, (void)where, (void)met, (void)x;
}

SHARED_FN void watch_step_end(Watcher* watcher, const real* x) { (void)watcher, (void)x; }

#else

SHARED_FN void watch_segment(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                             const real* x) {
  (void)watcher, (void)point, (void)stage, (void)x;
}

SHARED_FN void watch_step(Watcher* watcher, const ModelPoint* point, TABLE PhaseCoefs* stage,
                          scalar share, const real* middle, const real* x) {
  (void)watcher, (void)point, (void)stage, (void)share, (void)middle, (void)x;
}

#endif
