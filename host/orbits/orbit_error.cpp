#include "orbits/orbit_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

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

}  // namespace

OrbitError error_of(const Orbit& orbit, const PeriodMap& coarser) {
  const Eigen::VectorXd none =
      Eigen::VectorXd::Constant(orbit.state.size(), std::numeric_limits<double>::infinity());
  OrbitError error{none, none, std::nullopt};
  const std::optional<Orbit> coarse = shoot(coarser, orbit.state, orbit.period);
  if (!coarse) return error;
  // Each state's own change may be small by chance.
  const double change =
      (coarse->state - orbit.state).cwiseQuotient(orbit.sizes).cwiseAbs().maxCoeff();
  error.state = kErrorPerChange * change * orbit.sizes + kRounding * orbit.reach;
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
