#include "borders/find_breaking.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace gearsweep {
namespace {

constexpr double kOwnImage = 1e-4;  // of the states' sizes
// The equations of a fold are solved to the root of a residual there.
constexpr double kNearImage = 0.03;
constexpr double kFarBreaking = 2.0;  // in scaled unknowns

}  // namespace

bool is_own_image(const ParameterPlane& plane, HostOrbitMap* map, const HeldOrbit& orbit) {
  if (orbit.period % 2 == 0) return false;
  OrbitQuery query{{orbit.place.begin(), orbit.place.end()}, orbit.state, orbit.period};
  query.is_half = true;
  const std::optional<OrbitAnswer> answer = map->answer({query}).front();
  if (!answer) return false;
  return residual_of(plane, *answer, orbit.state, orbit.sizes).cwiseAbs().maxCoeff() < kOwnImage;
}

bool is_breaking(const ParameterPlane& plane, HostOrbitMap* map, const BorderEquations& equations,
                 const BorderPoint& point) {
  if (equations.period() % 2 == 0) return false;
  OrbitQuery query{{point.place.begin(), point.place.end()}, point.state, equations.period()};
  query.is_half = true;
  const std::optional<OrbitAnswer> answer = map->answer({query}).front();
  const Eigen::VectorXd& sizes = equations.scale().sizes;
  if (!answer ||
      residual_of(plane, *answer, point.state, sizes).cwiseAbs().maxCoeff() > kNearImage) {
    return false;
  }
  const Eigen::VectorXcd multipliers = answer->derivative.eigenvalues();
  const auto off = [&](double at) { return (multipliers.array() - at).abs().minCoeff(); };
  return off(-1.0) < off(1.0);
}

std::optional<Crossing> find_breaking(const ParameterPlane& plane, HostOrbitMap* map,
                                      const HeldOrbit& orbit, const PlanePlace& there,
                                      double reach) {
  const BorderScale scale = {orbit.sizes, {plane.range(0), plane.range(1)}};
  auto equations = std::make_unique<BorderEquations>(plane, map, BorderKind::symmetry_breaking,
                                                     orbit.period, scale);
  BorderPoint near;
  near.place = orbit.place;
  near.state = orbit.state;
  const Eigen::VectorXd guess = equations->unknowns_of(near);
  const std::optional<Critical> vectors = equations->critical_near(guess);
  if (!vectors) return std::nullopt;
  const double x = (there[0] - orbit.place[0]) / plane.range(0),
               y = (there[1] - orbit.place[1]) / plane.range(1);
  Eigen::VectorXd across = Eigen::VectorXd::Zero(guess.size());
  across[guess.size() - 2] = y;
  across[guess.size() - 1] = -x;
  std::optional<BorderPoint> found =
      equations->correct(guess, across.normalized(), *vectors, kFarBreaking);
  if (!found || !found->is_of_stable_motion()) return std::nullopt;
  const double gone = std::hypot((found->place[0] - orbit.place[0]) / plane.range(0),
                                 (found->place[1] - orbit.place[1]) / plane.range(1));
  if (gone > reach * std::hypot(x, y)) return std::nullopt;
  return Crossing{std::move(equations), *std::move(found)};
}

}  // namespace gearsweep
