#include "tile/detail/orbit_convergence.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "tile/detail/state_distance.hpp"

namespace gearsweep {
namespace {

constexpr double kHalf = 0.5;  // of a distance is left after a span
// The returns of a whole span must go as the derivative says, and so many at least. Fewer may agree
// by chance: a trajectory that passes the orbit, where a limit grazed is nearer than it comes, has
// a moment at which it is where the derivative would have taken it.
constexpr Eigen::Index kReturns = 3;
// Returns that the derivative does not explain, beside those of two spans, before a trajectory is
// given up whose distance does not halve.
constexpr Eigen::Index kPatience = 8;

// The sum of (M/r)'^k (M/r)^k over all k, by doubling the number of terms.
Eigen::MatrixXd contracting_metric(const Eigen::MatrixXd& map, double contraction) {
  Eigen::MatrixXd power = map / contraction;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(map.rows(), map.cols());
  Eigen::MatrixXd half(map.rows(), map.cols()), more = half, square = half;
  for (int doubling = 0; doubling < 24; ++doubling) {
    half.noalias() = power.transpose() * sum;
    more.noalias() = half * power;
    sum += more;
    if (more.norm() <= 1e-12 * sum.norm()) break;
    square.noalias() = power * power;
    power.swap(square);
  }
  return sum;
}

}  // namespace

OrbitConvergence::OrbitConvergence(TargetOrbit orbit, int longest_span) : orbit_(std::move(orbit)) {
  const auto states = static_cast<Eigen::Index>(orbit_.state.size());
  const Eigen::Map<const Eigen::VectorXd> ranges(orbit_.ranges.data(), states);
  const Eigen::Map<const Eigen::MatrixXd> derivative(orbit_.derivative.data(), states, states);
  const Eigen::MatrixXd once =
      ranges.cwiseInverse().asDiagonal() * derivative * ranges.asDiagonal();
  double left = orbit_.multiplier;
  for (map_ = once; left > kHalf && span_ < longest_span; left *= orbit_.multiplier, ++span_) {
    map_ = map_ * once;
  }
  contraction_ = 0.5 * (1.0 + left);
  metric_ = contracting_metric(map_, contraction_);
  noise_ = orbit_.same * std::sqrt(metric_.cwiseAbs().sum());
  last_.resize(states, span_);
}

// Lazy products: this is asked of every return, and they take no memory.
double OrbitConvergence::norm(const Eigen::VectorXd& distance) const {
  return std::sqrt(distance.dot(metric_.lazyProduct(distance)));
}

// Half of the contraction is left to what is not linear. Or both distances count as none.
bool OrbitConvergence::is_explained(const Eigen::VectorXd& distance, double now) const {
  const Eigen::VectorXd first = last_.col(returns_ % span_);
  const double before = norm(first);
  if (before <= noise_ && now <= noise_) return true;
  return norm(distance - map_.lazyProduct(first)) <= 0.5 * (1.0 - contraction_) * before;
}

OrbitConvergence::Verdict OrbitConvergence::add(std::span<const double> state) {
  const Eigen::VectorXd distance =
      relative_difference(state, orbit_.state, orbit_.ranges, orbit_.angles);
  if (!distance.allFinite()) return Verdict::leaves;
  const double now = norm(distance);
  if (returns_ == 0 || now <= kHalf * surprised_from_) {
    surprised_from_ = now;
    surprises_ = 0;
  }
  if (returns_ >= span_) {
    const bool as_expected = is_explained(distance, now);
    explained_ = as_expected ? explained_ + 1 : 0;
    if (explained_ == std::max(kReturns, span_)) return Verdict::converges;
    if (!as_expected && ++surprises_ >= kPatience + 2 * span_) return Verdict::leaves;
  }
  last_.col(returns_++ % span_) = distance;
  return Verdict::open;
}

}  // namespace gearsweep
