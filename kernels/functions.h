// Functions of equations that neither OpenCL nor C++ has. No include guard: it goes with
// model_types.h.

// (sqrt(1 + x) - 1)/(x/2) = 2/(1 + sqrt(1 + x)). On CPUs a square root and a division at every
// stage make the step of gear5 a quarter longer. For |x| < 1/128 the Taylor series does. With
// p = x/2 it is 1 - p/2 + p^2/2 - 5 p^3/8 + 7 p^4/8 - 21 p^5/16 + 33 p^6/16 - 429 p^7/128: each
// coefficient is less than twice the one before, and so what is cut off is at most
// |c_n p^n|/(1 - 2 |p|) for c_n p^n the first term of it, relative to a sum that is at least
// 1 - |p|/2. In fp64 (n = 7) that is less than 4.8e-17, in fp32 (n = 3) 3.8e-8: below half a unit
// in the last place, 1.1e-16 and 6.0e-8. Each lane takes the form that its own x asks for, so no
// value depends on the neighbours; a work-item whose lanes are all near skips the other form.
SHARED_FN real root_ratio(const real x) {
  const real near_squared = (scalar)(1.0 / 16384.0);
  const real c0 = 1;
  const real c1 = (scalar)(-1.0 / 4.0);
  const real c2 = (scalar)(1.0 / 8.0);
  const real c3 = (scalar)(-5.0 / 64.0);
  const real c4 = (scalar)(7.0 / 128.0);
  const real c5 = (scalar)(-21.0 / 512.0);
  const real c6 = (scalar)(33.0 / 1024.0);
  const real x2 = x * x;
  real higher = c2;
  if (REAL_BITS != 32) higher = (c2 + c3 * x) + ((c4 + c5 * x) + c6 * x2) * x2;
  real ratio = (c0 + c1 * x) + higher * x2;
  if (!all_lanes(x2 < near_squared)) {
    const real exact = (scalar)(2) / (c0 + lane_sqrt(c0 + x));
    ratio = lane_select(x2 < near_squared, ratio, exact);
  }
  return ratio;
}

// sqrt(1 + x) - 1, without a difference of nearly equal numbers.
SHARED_FN real lane_sqrt1pm1(const real x) {
  const real p = (scalar)(0.5) * x;
  return p * root_ratio(x);
}

#ifdef __OPENCL_VERSION__
// base to the power of exponent. PoCL 3.1's own, of eight doubles, is wrong in other lanes where
// the base is 0 in one.
SHARED_FN real lane_pow(const real base, const real exponent) {
  const real zero = 0;
  const real one = 1;
  const real power = pow(lane_select(base == zero, one, base), exponent);
  const real of_zero =
      lane_select(zero < exponent, zero, lane_select(exponent == zero, one, one / zero));
  return lane_select(base == zero, of_zero, power);
}
#endif
