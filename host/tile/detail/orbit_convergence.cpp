#include "tile/detail/orbit_convergence.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "model/eigenvalues.hpp"
#include "tile/detail/state_distance.hpp"

namespace gearsweep {
namespace {

constexpr double kHalf = 0.5;  // of a distance is left after a span
// The returns of a whole span must go as the derivative says, and so many at least. Fewer may agree
// by chance: a trajectory that passes the orbit, where a limit grazed is nearer than it comes, has
// a moment at which it is where the derivative would have taken it.
constexpr std::size_t kReturns = 3;
// Returns that the derivative does not explain, beside those of two spans, before a trajectory is
// given up whose distance does not halve.
constexpr std::size_t kPatience = 8;

// The sum of (M/r)'^k (M/r)^k over all k, by doubling the number of terms.
Eigen::MatrixXd contracting_metric(const Eigen::MatrixXd& map, double contraction) {
  Eigen::MatrixXd power = map / contraction;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(map.rows(), map.cols());
  for (int doubling = 0; doubling < 24; ++doubling) {
    const Eigen::MatrixXd more = power.transpose() * sum * power;
    sum += more;
    if (more.norm() <= 1e-12 * sum.norm()) break;
    power = power * power;
  }
  return sum;
}

// NaN, with which nothing ever converges, when the eigenvalues cannot be found.
double largest_modulus(const Eigen::MatrixXd& map) {
  const std::vector<std::complex<double>> values =
      eigenvalues(map.data(), static_cast<std::size_t>(map.rows()));
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  double largest = 0.0;
  for (const std::complex<double>& value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

OrbitConvergence::OrbitConvergence(OrbitMap orbit) : orbit_(std::move(orbit)) {
  const auto states = static_cast<Eigen::Index>(orbit_.state.size());
  const Eigen::Map<const Eigen::VectorXd> ranges(orbit_.ranges.data(), states);
  const Eigen::Map<const Eigen::MatrixXd> derivative(orbit_.derivative.data(), states, states);
  const Eigen::MatrixXd once =
      ranges.cwiseInverse().asDiagonal() * derivative * ranges.asDiagonal();
  const double multiplier = largest_modulus(once);
  double left = multiplier;
  for (map_ = once; left > kHalf; left *= multiplier, ++span_) map_ = map_ * once;
  contraction_ = 0.5 * (1.0 + left);
  metric_ = contracting_metric(map_, contraction_);
  noise_ = orbit_.same * std::sqrt(metric_.cwiseAbs().sum());
}

double OrbitConvergence::norm(const Eigen::VectorXd& distance) const {
  return std::sqrt(distance.dot(metric_ * distance));
}

// Half of the contraction is left to what is not linear. Or both distances count as none.
bool OrbitConvergence::is_explained(const Eigen::VectorXd& distance) const {
  const Eigen::VectorXd& first = last_.front();
  const double before = norm(first);
  if (before <= noise_ && norm(distance) <= noise_) return true;
  return norm(distance - map_ * first) <= 0.5 * (1.0 - contraction_) * before;
}

OrbitConvergence::Verdict OrbitConvergence::add(std::span<const double> state) {
  const Eigen::VectorXd distance =
      relative_difference(state, orbit_.state, orbit_.ranges, orbit_.angles);
  if (!distance.allFinite()) return Verdict::leaves;
  const double now = norm(distance);
  if (last_.empty() || now <= kHalf * surprised_from_) {
    surprised_from_ = now;
    surprises_ = 0;
  }
  if (last_.size() == span_) {
    const bool as_expected = is_explained(distance);
    explained_ = as_expected ? explained_ + 1 : 0;
    if (explained_ == std::max(kReturns, span_)) return Verdict::converges;
    if (!as_expected && ++surprises_ >= kPatience + 2 * span_) return Verdict::leaves;
    last_.pop_front();
  }
  last_.push_back(distance);
  return Verdict::open;
}

}  // namespace gearsweep
