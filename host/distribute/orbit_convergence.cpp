#include "distribute/orbit_convergence.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "distribute/state_distance.hpp"

namespace gearsweep {
namespace {

// So many returns in a row, and half of the distance, must go as the derivative says: then its
// slowest direction has been seen at work, and not only its fast ones.
constexpr std::size_t kReturns = 3;
constexpr double kFall = 0.5;
// Returns that the derivative does not explain, beside those in which the distance should halve
// twice, before a trajectory is given up whose distance does not halve.
constexpr double kPatience = 8.0;

// The sum of (M/r)'^k (M/r)^k over all k, by doubling the number of terms.
Eigen::MatrixXd contracting_metric(const Eigen::MatrixXd& map, double contraction) {
  Eigen::MatrixXd power = map / contraction;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(map.rows(), map.cols());
  // Enough for multipliers up to 1 - 1e-6.
  for (int doubling = 0; doubling < 24; ++doubling) {
    const Eigen::MatrixXd more = power.transpose() * sum * power;
    sum += more;
    if (more.norm() <= 1e-12 * sum.norm()) break;
    power = power * power;
  }
  return sum;
}

}  // namespace

OrbitConvergence::OrbitConvergence(OrbitMap orbit) : orbit_(std::move(orbit)) {
  const auto states = static_cast<Eigen::Index>(orbit_.state.size());
  const Eigen::Map<const Eigen::VectorXd> ranges(orbit_.ranges.data(), states);
  const Eigen::Map<const Eigen::MatrixXd> derivative(orbit_.derivative.data(), states, states);
  map_ = ranges.cwiseInverse().asDiagonal() * derivative * ranges.asDiagonal();
  const double multiplier = map_.eigenvalues().cwiseAbs().maxCoeff();
  contraction_ = 0.5 * (1.0 + multiplier);
  patience_ = kPatience + 2.0 * std::log(kFall) / std::log(multiplier);
  metric_ = contracting_metric(map_, contraction_);
  noise_ = orbit_.same * std::sqrt(metric_.cwiseAbs().sum());
}

double OrbitConvergence::norm(const Eigen::VectorXd& distance) const {
  return std::sqrt(distance.dot(metric_ * distance));
}

// By the derivative, from the distance before: half of the contraction is left to what is not
// linear. Or both distances count as none.
bool OrbitConvergence::is_explained(const Eigen::VectorXd& distance) const {
  const double before = norm(last_);
  if (before <= noise_ && norm(distance) <= noise_) return true;
  return norm(distance - map_ * last_) <= 0.5 * (1.0 - contraction_) * before;
}

OrbitConvergence::Verdict OrbitConvergence::add(const double* state) {
  const Eigen::VectorXd distance =
      relative_difference(state, orbit_.state.data(), orbit_.ranges, orbit_.angles);
  if (!distance.allFinite()) return Verdict::leaves;
  const double now = norm(distance);
  const bool is_first = last_.size() == 0;
  if (is_first || now <= kFall * surprised_from_) {
    surprised_from_ = now;
    surprises_ = 0;
  }
  if (!is_first && is_explained(distance)) {
    ++explained_;
  } else {
    if (!is_first && ++surprises_ >= patience_) return Verdict::leaves;
    explained_ = 0;
    first_norm_ = now;
  }
  last_ = distance;
  const bool is_near = now <= std::max(kFall * first_norm_, noise_);
  return explained_ >= kReturns && is_near ? Verdict::converges : Verdict::open;
}

}  // namespace gearsweep
