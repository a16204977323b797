#include "orbits/orbit_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "orbits/shooting.hpp"

namespace gearsweep {
namespace {

// What rounding and the end of Newton's iteration leave, of the states' magnitudes.
constexpr double kRounding = 1e-12;
// The error at any phase, in errors at phase 0: what the flow makes of it.
constexpr double kWorstPhase = 10.0;

// The distance of each multiplier to its own counterpart.
Eigen::VectorXd shifts(const Eigen::VectorXcd& fine, const Eigen::VectorXcd& coarse) {
  std::vector<std::complex<double>> left(coarse.begin(), coarse.end());
  Eigen::VectorXd out(fine.size());
  for (Eigen::Index i = 0; i < fine.size(); ++i) {
    const auto nearest =
        std::min_element(left.begin(), left.end(), [&](const auto& a, const auto& b) {
          return std::abs(a - fine[i]) < std::abs(b - fine[i]);
        });
    out[i] = std::abs(*nearest - fine[i]);
    left.erase(nearest);
  }
  return out;
}

// What rounding does to an equilibrium: the eigenvalues are computed again with entries of the
// Jacobian that differ by more than theirs.
OrbitError error_of_rest(const Orbit& orbit) {
  Eigen::MatrixXd jacobian = orbit.monodromy;
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
    for (Eigen::Index j = 0; j < jacobian.cols(); ++j) {
      jacobian(i, j) *= 1.0 + ((i + j) % 2 == 0 ? kRounding : -kRounding);
    }
  }
  const Orbit other = make_equilibrium(orbit.state, jacobian, orbit.sizes);
  const double fastest = orbit.multipliers.cwiseAbs().maxCoeff();
  return {
      kRounding * orbit.sizes,
      kErrorPerChange * shifts(orbit.multipliers, other.multipliers).array() + kRounding * fastest,
      0.0, std::nullopt};
}

}  // namespace

OrbitError error_of(const Orbit& orbit, const PeriodMap& coarser) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  OrbitError error{Eigen::VectorXd::Constant(orbit.state.size(), kUnknown),
                   Eigen::VectorXd::Constant(orbit.multipliers.size(), kUnknown), kUnknown,
                   std::nullopt};
  if (orbit.kind == OrbitKind::equilibrium) return error_of_rest(orbit);
  const std::optional<Orbit> coarse = shoot_again(coarser, orbit, (orbit.steps + 1) / 2);
  if (!coarse) return error;
  // Each state's own change may be small by chance.
  const double change = distance_of(coarser.difference(coarse->state, orbit.state), orbit.sizes);
  error.state = kErrorPerChange * change * orbit.sizes + kRounding * orbit.extent.reach();
  error.duration =
      kErrorPerChange * std::fabs(coarse->duration - orbit.duration) + kRounding * orbit.duration;
  const double stretch = std::max(1.0, stretch_of(orbit.monodromy, orbit.sizes));
  error.multipliers = kErrorPerChange * shifts(orbit.multipliers, coarse->multipliers).array() +
                      kRounding * stretch;
  const Eigen::VectorXd at_worst = kWorstPhase * error.state;
  const Graze* const graze = orbit.graze_within(at_worst);
  if (graze != nullptr) {
    error.graze_distance = graze->distance;
    const double depth = graze->gradient.cwiseAbs().dot(at_worst);
    // So long may a flank touch that does not, or the other way round.
    const double time = 2.0 * std::sqrt(2.0 * (graze->distance + depth) / graze->bend);
    error.multipliers.array() +=
        time * stretch_of(graze->force * graze->gradient, orbit.sizes) * stretch;
  }
  return error;
}

}  // namespace gearsweep
