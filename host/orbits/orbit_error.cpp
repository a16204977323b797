#include "orbits/orbit_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace gearsweep {
namespace {

// What rounding and the end of Newton's iteration leave, of the size of the numbers.
constexpr double kRounding = 1e-12;
// The error at any phase, in errors at phase 0: what the flow makes of it, and the deflection is a
// sum of states.
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
  const double none = std::numeric_limits<double>::infinity();
  OrbitError error{none, Eigen::VectorXd::Constant(orbit.multipliers.size(), none), false};
  const std::optional<Orbit> coarse = shoot(coarser, orbit.state, orbit.period);
  if (!coarse) return error;
  error.state = kErrorPerChange * (coarse->state - orbit.state).cwiseAbs().maxCoeff() +
                kRounding * scale_of(orbit.state);
  const double stretch = std::max(1.0, orbit.monodromy.cwiseAbs().maxCoeff());
  error.multipliers = kErrorPerChange * shifts(orbit.multipliers, coarse->multipliers).array() +
                      kRounding * stretch;
  const double depth = kWorstPhase * error.state;
  error.grazing = orbit.graze.distance < depth;
  if (error.grazing) {
    // So long may a flank touch that does not, or the other way round.
    const double time = 2.0 * std::sqrt(2.0 * (orbit.graze.distance + depth) / orbit.graze.bend);
    error.multipliers.array() += time * orbit.graze.jump * stretch;
  }
  return error;
}

}  // namespace gearsweep
