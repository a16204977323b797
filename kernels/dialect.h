// The words that differ between OpenCL C and C++. The device compiler gets REAL_BITS (32 or 64),
// LANES (points per work-item) and CONTRACT (0 forbids fused multiply-add) as build macros; a C++
// includer of a model declares the type `real` (and `scalar`, the type of table entries) itself, in
// the namespace that it includes the model into, and REAL_BITS is what that type has.
#ifndef GEARSWEEP_DIALECT_H
#define GEARSWEEP_DIALECT_H

#define TWO_PI 6.283185307179586476925

#ifdef __OPENCL_VERSION__

#if !CONTRACT
#pragma OPENCL FP_CONTRACT OFF
#endif

#if REAL_BITS == 64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define SCALAR_NAME double
#define MASK_NAME long
#else
#define SCALAR_NAME float
#define MASK_NAME int
#endif
#define JOIN_NOW(a, b) a##b
#define JOIN(a, b) JOIN_NOW(a, b)

// scalar: one number. real: the same number for each of LANES points. mask: what comparing two
// reals gives (-1 or 0 in each lane; 1 or 0 when there is one lane).
typedef SCALAR_NAME scalar;
#if LANES == 1
typedef SCALAR_NAME real;
typedef int mask;
#define all_lanes(m) (m)
#else
typedef JOIN(SCALAR_NAME, LANES) real;
typedef JOIN(MASK_NAME, LANES) mask;
#define all_lanes(m) all(m)
#ifdef __has_builtin
#if __has_builtin(__builtin_reduce_and)
// PoCL's all() makes a branch of every other lane; this is one test.
#undef all_lanes
#define all_lanes(m) (__builtin_reduce_and(m) != 0)
#endif
#endif
#endif

// One lane of a real or a mask that lies in memory, and numbers of reals one by one.
#if LANES == 1
#define LANE(value, lane) (value)
#define SCALARS(numbers) (numbers)
#else
#define LANE(value, lane) ((value)[lane])
#define SCALARS(numbers) ((__global scalar*)(numbers))
#endif

#define SHARED_FN static inline __attribute__((always_inline))
#ifdef __clang__
// "unroll" alone may leave a part of a loop, and with it an array in memory.
#define UNROLL _Pragma("clang loop unroll(full)")
#else
#define UNROLL _Pragma("unroll")
#endif
#define TABLE __global const
#define lane_sqrt(a) sqrt(a)
#define lane_abs(a) fabs(a)
#define lane_rint(a) rint(a)
#define lane_floor(a) floor(a)
#define lane_log(a) log(a)
#define lane_sin(a) sin(a)
#define lane_cos(a) cos(a)
#define LANE_FN SHARED_FN

#else

// There is one lane on the host.
typedef bool mask;
#define SHARED_FN [[maybe_unused]] static inline
#define UNROLL
#define TABLE const
#ifndef REAL_BITS
#define REAL_BITS ((int)(8 * sizeof(real)))
#endif
#define all_lanes(m) (m)
#define lane_sqrt(a) sqrt(a)
#define lane_abs(a) fabs(a)
#define lane_rint(a) rint(a)
#define lane_floor(a) floor(a)
#define lane_log(a) log(a)
#define lane_sin(a) sin(a)
#define lane_cos(a) cos(a)
#define LANE_FN         \
  template <class real> \
  static inline

#endif

// Lane-wise choice; a NaN compares false, so lane_min(NaN, b) is NaN and lane_min(a, NaN) is a.
#define lane_select(condition, yes, no) ((condition) ? (yes) : (no))
LANE_FN real lane_min(const real a, const real b) { return lane_select(b < a, b, a); }
LANE_FN real lane_max(const real a, const real b) { return lane_select(a < b, b, a); }
LANE_FN real lane_clamp(const real a, const real low, const real high) {
  return lane_min(lane_max(a, low), high);
}

#endif
