// What crosses the border between host and device: launch arguments and status codes.
#ifndef GEARSWEEP_SWEEP_TYPES_H
#define GEARSWEEP_SWEEP_TYPES_H

#ifdef __OPENCL_VERSION__
typedef uint sweep_uint;
#else
#include <cstdint>
typedef std::uint32_t sweep_uint;
#endif

// Why a point ended: X(NAME, code, meaning).
#define SWEEP_STATUSES(X)                                                                  \
  X(ok, 0, "integrated and recorded to the end")                                           \
  X(diverged, 1, "left the range of meaningful numbers, or its steps are too long")        \
  X(unstable_start, 2, "starts at an unstable equilibrium: rounding decides what follows") \
  X(step_too_long, 3, "ends where its steps are too long to follow the motion")
#define SWEEP_STATUS_CODE(name, code, meaning) STATUS_##name = code,
enum { SWEEP_STATUSES(SWEEP_STATUS_CODE) };

// Kinds of motion, the values of motion_class (observables/motion.h, return_motion.h).
enum {
  MOTION_undecided,
  MOTION_periodic,
  MOTION_quasi_periodic,
  MOTION_chaotic,
  MOTION_equilibrium
};

// The row of a parameter that is the same for all points.
#define NOT_SWEPT 0xffffffffu

// The longest period, in forcing periods, of an orbit that ends a point's settling.
#define ORBIT_LONGEST 16

// One kernel launch. A work-item is LANES points, so `items` is the tile's padded points / LANES.
typedef struct {
  sweep_uint items;     // work-items that hold points; the global size is rounded up beyond it
  sweep_uint periods;   // periods to advance in this round
  sweep_uint done;      // periods of the same kind (settling, recording, ...) before this round
  sweep_uint record;    // periods that will be recorded in all
  sweep_uint samples;   // of these, the first so many give samples of the section
  sweep_uint settled;   // periods before the first recorded one
  sweep_uint is_last;   // not 0: no longer record will follow, so this one must do for a verdict
  sweep_uint is_early;  // not 0: the motion goes on to a longer one, unless it has settled
} SweepRound;

// Where one phase grid lies in the tables of its tile.
typedef struct {
  sweep_uint first_stage;    // index of the first PhaseCoefs
  sweep_uint first_segment;  // index of the first segment
  sweep_uint segments;       // segments (parts of the period between break phases)
} SweepGrid;

#endif
