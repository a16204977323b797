#include "reference/detail/crossing.hpp"

#include <cmath>

namespace gearsweep {
namespace {

// Weights of the four evaluations in the parabola's value at share u of the step. It goes through
// the first, the last and the mean of the two in the middle.
Eigen::Vector4d parabola(double u) {
  const double middle = 2.0 * u * (1.0 - u);
  return {(1.0 - 2.0 * u) * (1.0 - u), middle, middle, u * (2.0 * u - 1.0)};
}

// The parabola's root, where its ends differ in sign.
double root(const Eigen::Vector4d& p) {
  double low = 0.0;
  double high = 1.0;
  while (true) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    ((p.dot(parabola(middle)) > 0.0) == (p[0] > 0.0) ? low : high) = middle;
  }
}

}  // namespace

std::optional<CrossingWeights> crossing_weights(const Eigen::Vector4d& seen,
                                                const Eigen::Vector4d& p, double flank) {
  const bool contact_before = flank * seen[0] > 0.0;
  const bool contact_after = flank * seen[3] > 0.0;
  if (contact_before == contact_after) return std::nullopt;
  const double from = root(p);
  // Simpson's rule, exact for the parabola and for its product with the lever 1 - u.
  const double length = 1.0 - from;
  const Eigen::Vector4d middle = 4.0 * parabola(from + 0.5 * length);
  CrossingWeights weights;
  weights.sum = length / 6.0 * (parabola(from) + middle + parabola(1.0));
  weights.moment = length / 6.0 * (length * parabola(from) + 0.5 * length * middle);
  // What the evaluations saw; those in the middle stand at the levers of their weights.
  for (Eigen::Index i = 1; i < 4; ++i) {
    if ((flank * seen[i] > 0.0) != contact_after) continue;
    weights.sum[i] -= i < 3 ? 1.0 / 3.0 : 1.0 / 6.0;
    if (i < 3) weights.moment[i] -= 1.0 / 6.0;
  }
  if (contact_before) {
    weights.sum = -weights.sum;
    weights.moment = -weights.moment;
  }
  return weights;
}

Eigen::Matrix4d crossing_feedback(const Eigen::Vector4d& seen, double flank, double feedback) {
  const bool contact_after = flank * seen[3] > 0.0;
  const double gain = contact_after ? feedback : -feedback;
  const auto is_beyond = [&](Eigen::Index i) { return (flank * seen[i] > 0.0) == contact_after; };
  Eigen::Matrix4d clean = Eigen::Matrix4d::Identity();
  if (is_beyond(1)) clean(2, 1) -= 0.5 * gain;
  if (is_beyond(2)) clean(3, 2) -= gain;
  return clean;
}

}  // namespace gearsweep
