#include "distribute/orbit_newton.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

// Multipliers of an orbit that is taken for stable stay below this. Nearer to 1 the steps' kinks at
// contact, which move with the state, could decide.
constexpr double kStable = 0.97;
// Where Newton's method converges, each step does better than this, soon much better.
constexpr double kSlow = 0.2;
// What stands for the logarithm of zero.
constexpr double kLeast = 1e-30;

std::vector<double> log_moduli(const Eigen::MatrixXd& derivative) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(derivative, false);
  std::vector<double> logs;
  if (solver.info() != Eigen::Success) return logs;
  for (const std::complex<double>& value : solver.eigenvalues()) {
    logs.push_back(std::log(std::max(std::abs(value), kLeast)));
  }
  std::sort(logs.rbegin(), logs.rend());
  return logs;
}

// (I - derivative)^-1 (mapped - state): what Newton's method adds to the state.
Eigen::VectorXd correction(const double* mapped, const double* derivative, const NewtonTry& one) {
  const auto states = static_cast<Eigen::Index>(one.state.size());
  const Eigen::Map<const Eigen::VectorXd> end(mapped, states);
  const Eigen::Map<const Eigen::VectorXd> state(one.state.data(), states);
  const Eigen::Map<const Eigen::MatrixXd> slope(derivative, states, states);
  return (Eigen::MatrixXd::Identity(states, states) - slope).partialPivLu().solve(end - state);
}

}  // namespace

NewtonVerdict newton_step(const double* mapped, const double* derivative,
                          const NewtonLimits& limits, std::size_t tangents, NewtonTry* one) {
  const auto states = static_cast<Eigen::Index>(one->state.size());
  const Eigen::Map<const Eigen::VectorXd> end(mapped, states);
  const Eigen::Map<const Eigen::MatrixXd> slope(derivative, states, states);
  const Eigen::Map<const Eigen::VectorXd> start(one->start.data(), states);
  Eigen::Map<Eigen::VectorXd> state(one->state.data(), states);
  if (!end.allFinite() || !slope.allFinite()) return NewtonVerdict::failed;

  const double scale = start.lpNorm<Eigen::Infinity>();
  const double distance = (end - state).lpNorm<Eigen::Infinity>();
  if (distance > kSlow * one->distance) return NewtonVerdict::failed;
  one->distance = distance;
  const Eigen::VectorXd step = correction(mapped, derivative, *one);
  state += step;
  if (!state.allFinite()) return NewtonVerdict::failed;
  if ((state - start).lpNorm<Eigen::Infinity>() > limits.far * scale) return NewtonVerdict::failed;
  if (step.lpNorm<Eigen::Infinity>() > limits.close * scale) return NewtonVerdict::going_on;

  one->multipliers = log_moduli(slope);
  if (one->multipliers.empty()) return NewtonVerdict::failed;
  if (one->multipliers.front() > std::log(kStable)) return NewtonVerdict::unstable;
  if (tangents > 1 &&
      one->multipliers[tangents - 1] - one->multipliers.front() < std::log(limits.weakest)) {
    return NewtonVerdict::failed;
  }
  return NewtonVerdict::close;
}

NewtonVerdict newton_confirm(const double* mapped, const double* derivative,
                             const NewtonLimits& limits, NewtonTry* one) {
  const auto states = static_cast<Eigen::Index>(one->state.size());
  const Eigen::Map<const Eigen::VectorXd> end(mapped, states);
  const Eigen::Map<const Eigen::VectorXd> start(one->start.data(), states);
  Eigen::Map<Eigen::VectorXd> state(one->state.data(), states);
  const bool comes_back =
      (end - state).lpNorm<Eigen::Infinity>() <= limits.same * start.lpNorm<Eigen::Infinity>();
  state += correction(mapped, derivative, *one);
  return comes_back && state.allFinite() ? NewtonVerdict::found : NewtonVerdict::going_on;
}

}  // namespace gearsweep
