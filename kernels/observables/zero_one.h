// The 0-1 test for chaos (G. A. Gottwald and I. Melbourne, SIAM J. Appl. Dyn. Syst. 8 (2009)
// 129-145) of the first state at phase 0 of each recorded period: K, near 0 for regular and near 1
// for chaotic motion. For an angle c the series drives a walk in the plane,
//   z(n) = sum of phi(j) exp(i c j) over j <= n,
// and K_c is the correlation of n with the walk's mean square displacement after n samples, for n
// to a tenth of the record (at most 128). K is the median of K_c over 31 angles in (pi/5, 4 pi/5).
// The series' mean is taken out of it first, which is what their oscillatory term does.
//
// The displacement needs the series only by its products: with N samples, J = N - n_cut and
//   C(k, l) = sum of phi(j + k) phi(j + l) over j = 0 .. J - 1,
// J times the mean square displacement after n samples is the sum of cos(c (k - l)) C(k, l) over
// k, l = 1 .. n, and C(k + 1, l + 1) = C(k, l) - phi(k) phi(l) + phi(J + k) phi(J + l).
// So C(1, l), the first and the last samples are all that is kept.

#define ZERO_ONE_ROLE verdict
// X(suffix of the quantity's name, unit, flag meanings, meaning)
#define ZERO_ONE_OUTPUTS(X) \
  X(, "1", "",              \
    "0-1 test for chaos of the first state; not a number when less than 100 periods are recorded")

enum { zero_one_max_lags = 128 };
enum {
  zero_one_origin,    // the samples below are less this
  zero_one_range,     // of the state, the largest so far
  zero_one_sum,       // of all samples
  zero_one_part_sum,  // of samples 1 .. J
  zero_one_head,      // the first samples
  zero_one_ring =
      zero_one_head + zero_one_max_lags,  // the last samples, i at i % zero_one_max_lags
  zero_one_products = zero_one_ring + zero_one_max_lags,  // C(1, 1 + m)
  zero_one_accumulators = zero_one_products + zero_one_max_lags
};

#ifdef __OPENCL_VERSION__
enum {
  zero_one_outputs = ZERO_ONE_OUTPUTS(COUNT_OUTPUT),
  zero_one_angles = 31,
  // Each product of the series waits for the one before, and is the same for all angles. On a GPU
  // other work-items fill the wait.
  zero_one_at_once = LANES > 1 ? 4 : 1
};

SHARED_FN uint zero_one_lags(uint record) { return min(record / 10, (uint)(zero_one_max_lags)); }

SHARED_FN void zero_one_init(real* sums, const Instant* start) {
  for (int i = 0; i < zero_one_accumulators; ++i) sums[i] = 0;
  sums[zero_one_origin] = start->x[0];
}

SHARED_FN void zero_one_step(real* sums, const Step* step) {}

SHARED_FN void zero_one_end_period(real* sums, const Section* section) {
  const uint number = section->number;
  const uint record = section->record;
  const uint lags = zero_one_lags(record);
  const uint i = number + 1;
  const real sample = section->x[0] - sums[zero_one_origin];
  real ranges[MODEL_STATE_COUNT];
  extent_ranges(section->extent, (scalar)(PERIOD_TOLERANCE), ranges);
  sums[zero_one_range] = lane_max(sums[zero_one_range], ranges[0]);
  sums[zero_one_sum] += sample;
  if (i + lags <= record) sums[zero_one_part_sum] += sample;
  if (number < zero_one_max_lags) sums[zero_one_head + number] = sample;
  sums[zero_one_ring + i % zero_one_max_lags] = sample;
  for (uint m = 0; m < lags && m < i; ++m) {
    if (i - m + lags > record) continue;
    sums[zero_one_products + m] += sample * sums[zero_one_ring + (i - m) % zero_one_max_lags];
  }
}

// head[k - 1] = phi(k), tail[k - 1] = phi(J + k), products[m] = C(1, 1 + m), without the mean.
SHARED_FN void zero_one_center(const real* sums, uint record, real* head, real* tail,
                               real* products) {
  const uint lags = zero_one_lags(record);
  const uint length = record - lags;
  const real mean = sums[zero_one_sum] / (scalar)(record);
  real window_sum = sums[zero_one_part_sum];  // of phi(1 + m) .. phi(J + m)
  for (uint m = 0; m < lags; ++m) {
    products[m] = sums[zero_one_products + m] -
                  mean * (sums[zero_one_part_sum] + window_sum - (scalar)(length)*mean);
    const real last = sums[zero_one_ring + (length + m + 1) % zero_one_max_lags];
    window_sum = window_sum + last - sums[zero_one_head + m];
    head[m] = sums[zero_one_head + m] - mean;
    tail[m] = last - mean;
  }
}

// Multiples of the golden ratio, less their whole part, lie neither evenly nor in clusters.
SHARED_FN scalar zero_one_angle(int number) {
  const scalar turn = (scalar)(0.6180339887498949) * (scalar)(number + 1);
  return (scalar)(M_PI / 5) * (1 + 3 * (turn - floor(turn)));
}

// rises[i][n - 1]: of the displacement from n - 1 to n, for angle first + i.
SHARED_FN void zero_one_rises(const real* head, const real* tail, const real* products, uint lags,
                              int first, real rises[zero_one_at_once][zero_one_max_lags]) {
  for (int i = 0; i < zero_one_at_once; ++i) {
    for (uint n = 0; n < lags; ++n) rises[i][n] = 0;
  }
  for (uint m = 0; m < lags; ++m) {
    scalar weights[zero_one_at_once];
    for (int i = 0; i < zero_one_at_once; ++i) {
      weights[i] =
          m == 0 ? (scalar)(1) : (scalar)(2) * cos(zero_one_angle(first + i) * (scalar)(m));
    }
    real product = products[m];
    for (uint k = 0; k + m < lags; ++k) {
      UNROLL
      for (int i = 0; i < zero_one_at_once; ++i) {
        rises[i][k + m] = rises[i][k + m] + weights[i] * product;
      }
      product = product + tail[k] * tail[k + m] - head[k] * head[k + m];
    }
  }
}

// K_c of one angle, whose rises become the displacements.
SHARED_FN real zero_one_correlation(real* rise, uint lags) {
  real displacement = 0;
  real sum = 0;
  for (uint n = 0; n < lags; ++n) {
    displacement = displacement + rise[n];
    rise[n] = displacement;
    sum = sum + displacement;
  }
  const real mean = sum / (scalar)(lags);
  const scalar middle = (scalar)(0.5) * (scalar)(lags - 1);
  real covariance = 0;
  real variance = 0;
  scalar count_variance = 0;
  for (uint n = 0; n < lags; ++n) {
    const scalar offset = (scalar)(n)-middle;
    const real deviation = rise[n] - mean;
    covariance = covariance + offset * deviation;
    variance = variance + deviation * deviation;
    count_variance += offset * offset;
  }
  return covariance / lane_sqrt(variance * count_variance);
}

// A series that stays at one value within PERIOD_TOLERANCE of the motion's range is regular,
// whatever its rounding does.
SHARED_FN void zero_one_finish(const real* sums, SweepRound round, real* out) {
  out[0] = NAN;
  if (round.record < 100) return;
  const uint lags = zero_one_lags(round.record);
  real head[zero_one_max_lags];
  real tail[zero_one_max_lags];
  real products[zero_one_max_lags];
  zero_one_center(sums, round.record, head, tail, products);
  real sorted[zero_one_angles];
  for (int first = 0; first < zero_one_angles; first += zero_one_at_once) {
    real rises[zero_one_at_once][zero_one_max_lags];
    zero_one_rises(head, tail, products, lags, first, rises);
    for (int i = 0; i < zero_one_at_once && first + i < zero_one_angles; ++i) {
      sorted[first + i] = zero_one_correlation(rises[i], lags);
    }
  }
  for (int pass = 1; pass < zero_one_angles; ++pass) {
    for (int i = 0; i + 1 < zero_one_angles; ++i) {
      const real high = lane_max(sorted[i], sorted[i + 1]);
      sorted[i] = lane_min(sorted[i], sorted[i + 1]);
      sorted[i + 1] = high;
    }
  }
  const real zero = 0;
  const real smallest = (scalar)(PERIOD_TOLERANCE)*sums[zero_one_range];
  const mask varies = products[0] > (scalar)(round.record - lags) * smallest * smallest;
  out[0] = lane_select(varies, sorted[zero_one_angles / 2], zero);
}
#endif
