#include "tile/detail/orbit_newton.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "model/eigenvalues.hpp"
#include "tile/detail/eigenvalue_bound.hpp"
#include "tile/detail/state_distance.hpp"

namespace gearsweep {
namespace {

// Multipliers of an orbit that is taken for stable stay below this. Nearer to 1 the steps' kinks at
// contact, which move with the state, could decide.
constexpr double kStable = 0.99;
// By so much, in relation to its distance from the orbit, a derivative's multipliers may be off.
constexpr double kChange = 2.0;
// Where Newton's method converges, each step does better than this, soon much better.
constexpr double kSlow = 0.2;

std::vector<double> log_moduli(const Eigen::MatrixXd& derivative, double lost) {
  std::vector<double> logs;
  for (const std::complex<double>& value :
       eigenvalues(derivative.data(), static_cast<std::size_t>(derivative.rows()))) {
    logs.push_back(std::log(std::abs(value) <= lost ? 0.0 : std::abs(value)));
  }
  std::sort(logs.rbegin(), logs.rend());
  return logs;
}

// The multipliers that are asked for: all of them, or, where none is, their bound if that is below
// `stable`.
std::vector<double> log_multipliers_of(const Eigen::MatrixXd& derivative, double lost,
                                       std::size_t tangents, double stable) {
  if (tangents == 0) {
    const double bound = eigenvalue_bound(derivative);
    if (bound < stable) return {std::log(bound <= lost ? 0.0 : bound)};
  }
  return log_moduli(derivative, lost);
}

// How far the map carries the guess, relative to the ranges.
Eigen::VectorXd moved(std::span<const double> mapped, const NewtonLimits& limits,
                      const NewtonTry& one) {
  return relative_difference(mapped, one.state, one.ranges, limits.angles);
}

// The map's derivative, relative to the ranges.
Eigen::MatrixXd relative_derivative(std::span<const double> derivative, const NewtonTry& one) {
  const auto states = static_cast<Eigen::Index>(one.state.size());
  const Eigen::Map<const Eigen::MatrixXd> slope(derivative.data(), states, states);
  const Eigen::Map<const Eigen::VectorXd> ranges(one.ranges.data(), states);
  return ranges.cwiseInverse().asDiagonal() * slope * ranges.asDiagonal();
}

// (I - derivative)^-1 moved: what Newton's method adds to the state, relative to the ranges.
Eigen::VectorXd correction(const Eigen::VectorXd& moved, const Eigen::MatrixXd& slope) {
  return (Eigen::MatrixXd::Identity(slope.rows(), slope.cols()) - slope)
      .partialPivLu()
      .solve(moved);
}

// False when the state is none any more.
bool correct(const Eigen::VectorXd& correction, NewtonTry* one) {
  const auto states = correction.size();
  Eigen::Map<Eigen::VectorXd> state(one->state.data(), states);
  state += correction.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(one->ranges.data(), states));
  return state.allFinite();
}

}  // namespace

double largest_log_multiplier(std::span<const double> derivative, std::size_t states, double lost) {
  const auto size = static_cast<Eigen::Index>(states);
  const Eigen::Map<const Eigen::MatrixXd> slope(derivative.data(), size, size);
  const std::vector<double> logs =
      slope.allFinite() ? log_moduli(slope, lost) : std::vector<double>();
  return logs.empty() ? std::numeric_limits<double>::quiet_NaN() : logs.front();
}

bool comes_back(std::span<const double> mapped, const NewtonLimits& limits, const NewtonTry& one) {
  return moved(mapped, limits, one).lpNorm<Eigen::Infinity>() <= limits.same;
}

NewtonVerdict newton_step(std::span<const double> mapped, std::span<const double> derivative,
                          const NewtonLimits& limits, std::size_t tangents, NewtonTry* one) {
  const Eigen::VectorXd by_map = moved(mapped, limits, *one);
  const Eigen::MatrixXd slope = relative_derivative(derivative, *one);
  if (!by_map.allFinite() || !slope.allFinite()) return NewtonVerdict::failed;

  const double distance = by_map.lpNorm<Eigen::Infinity>();
  if (distance > kSlow * one->distance) return NewtonVerdict::failed;
  one->distance = distance;
  const Eigen::VectorXd step = correction(by_map, slope);
  if (!correct(step, one)) return NewtonVerdict::failed;
  const Eigen::VectorXd away =
      relative_difference(one->state, one->start, one->ranges, limits.angles);
  if (away.lpNorm<Eigen::Infinity>() > limits.far) return NewtonVerdict::failed;
  one->step = step.lpNorm<Eigen::Infinity>();
  if (one->step > std::max(limits.close, limits.kept)) return NewtonVerdict::going_on;

  const bool is_beside = one->step > limits.close;
  const double stable = is_beside ? kStable - kChange * one->step : kStable;
  one->log_multipliers = log_multipliers_of(slope, limits.lost, tangents, stable);
  if (one->log_multipliers.empty()) return NewtonVerdict::failed;
  if (is_beside && one->log_multipliers.front() > std::log(stable)) {
    return NewtonVerdict::going_on;
  }
  if (one->log_multipliers.front() > std::log(kStable)) return NewtonVerdict::unstable;
  if (tangents > 1 && one->log_multipliers[tangents - 1] - one->log_multipliers.front() <
                          std::log(limits.weakest)) {
    return NewtonVerdict::failed;
  }
  return NewtonVerdict::close;
}

NewtonVerdict newton_confirm(std::span<const double> mapped, std::span<const double> derivative,
                             const NewtonLimits& limits, NewtonTry* one) {
  const Eigen::VectorXd by_map = moved(mapped, limits, *one);
  const double distance = by_map.lpNorm<Eigen::Infinity>();
  if (!correct(correction(by_map, relative_derivative(derivative, *one)), one)) {
    return NewtonVerdict::going_on;
  }
  if (distance <= limits.same) return NewtonVerdict::found;
  const bool is_fast = one->step > limits.close && distance <= kSlow * one->distance;
  if (is_fast) one->distance = distance;
  return is_fast ? NewtonVerdict::close : NewtonVerdict::going_on;
}

}  // namespace gearsweep
