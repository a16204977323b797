// Amplitude and phase of chosen orders of a state or signal: with psi the phase, n times the mesh
// frequency the order, and m the mesh periods in a forcing period (Model::mesh_periods), the
// order's angle is a = 2 pi n m (periods + psi), and the motion's part at that frequency is
//   amplitude cos(a + phase), which is the real part of 2/record times the integral of x exp(-i a).
// The integral is taken by Simpson's rule over each step, first over each period, with the angles
// a of psi alone, whose cosines and sines the host tabulates; then it is turned by the periods
// before. What a period turns stands in the table at its end. x is less its first value, so that
// sums keep their digits in fp32; over a record in which an order's waves fit, a constant is
// nothing.

#define ORDERS_ROLE measure
#define ORDERS_PER_CHANNEL
#define ORDERS_DIMENSION "order"
// X(suffix of the quantity's name, unit (empty: the channel's), flag meanings, meaning)
#define ORDERS_OUTPUTS(X)                                                     \
  X(order_amplitude, "", "", "amplitude of each order of the mesh frequency") \
  X(order_phase, "rad", "",                                                   \
    "phase of each order: it goes with cos(order 2 pi t/mesh period + phase), t from phase 0")
// X(suffix, role)
#define ORDERS_OUTPUT_ROLES(X) X(order_phase, angle)

enum {
  orders_origin,
  orders_cosine,                                          // integral of x cos(a)
  orders_sine = orders_cosine + PER_ORDER,                // and of x sin(a)
  orders_period_cosine = orders_sine + PER_ORDER,         // those of the running period,
  orders_period_sine = orders_period_cosine + PER_ORDER,  // with the angles of psi alone
  orders_turn_cosine = orders_period_sine + PER_ORDER,    // cos(2 pi n m periods)
  orders_turn_sine = orders_turn_cosine + PER_ORDER,
  orders_accumulators = orders_turn_sine + PER_ORDER
};

#ifdef __OPENCL_VERSION__
enum { orders_outputs = 2 * ORDER_COUNT };

SHARED_FN void orders_init(real* sums, real value) {
  UNROLL
  for (int i = 0; i < orders_accumulators; ++i) sums[i] = 0;
  sums[orders_origin] = value;
  UNROLL
  for (int k = 0; k < ORDER_COUNT; ++k) sums[orders_turn_cosine + k] = 1;
}

SHARED_FN void orders_step(real* sums, real earlier, real before, real middle, real after,
                           const Step* step) {
  const Share sixth_weight = (scalar)(1.0 / 6.0) * step->share;
  const real a = sixth_weight * (before - sums[orders_origin]);
  const real m = ((scalar)(4) * sixth_weight) * (middle - sums[orders_origin]);
  const real b = sixth_weight * (after - sums[orders_origin]);
  const OrdersAt* at_a = &step->before->orders;
  const OrdersAt* at_m = &step->middle->orders;
  const OrdersAt* at_b = &step->after->orders;
  UNROLL
  for (int k = 0; k < ORDER_COUNT; ++k) {
    sums[orders_period_cosine + k] =
        sums[orders_period_cosine + k] +
        ((a * at_a->cosine[k] + b * at_b->cosine[k]) + m * at_m->cosine[k]);
    sums[orders_period_sine + k] = sums[orders_period_sine + k] +
                                   ((a * at_a->sine[k] + b * at_b->sine[k]) + m * at_m->sine[k]);
  }
}

SHARED_FN void orders_end_period(real* sums, const Section* section) {
  const OrdersAt* end = &section->end->orders;
  UNROLL
  for (int k = 0; k < ORDER_COUNT; ++k) {
    const real cosine = sums[orders_turn_cosine + k];
    const real sine = sums[orders_turn_sine + k];
    const real by_cosine = sums[orders_period_cosine + k];
    const real by_sine = sums[orders_period_sine + k];
    sums[orders_cosine + k] += cosine * by_cosine - sine * by_sine;
    sums[orders_sine + k] += sine * by_cosine + cosine * by_sine;
    sums[orders_period_cosine + k] = 0;
    sums[orders_period_sine + k] = 0;
    sums[orders_turn_cosine + k] = cosine * end->cosine[k] - sine * end->sine[k];
    sums[orders_turn_sine + k] = sine * end->cosine[k] + cosine * end->sine[k];
  }
}

SHARED_FN void orders_finish(const real* sums, SweepRound round, real* out) {
  const scalar twice = (scalar)(2) / (scalar)(round.record);
  UNROLL
  for (int k = 0; k < ORDER_COUNT; ++k) {
    const real cosine = twice * sums[orders_cosine + k];
    const real sine = twice * sums[orders_sine + k];
    out[k] = lane_sqrt(cosine * cosine + sine * sine);
    out[ORDER_COUNT + k] = atan2(-sine, cosine);
  }
}
#endif
