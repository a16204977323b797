#include "borders/find_graze.hpp"

#include <algorithm>
#include <cmath>

namespace gearsweep {
namespace {

constexpr std::size_t kMostTurns = 3;  // that are tried
constexpr double kFarGraze = 2.0;      // in scaled unknowns: from an orbit to a graze beside it

}  // namespace

std::vector<Crossing> find_grazes(const ParameterPlane& plane, HostOrbitMap* map,
                                  const GrazeSeed& seed) {
  const HeldOrbit& orbit = seed.orbit;
  std::vector<OrbitWay::Seen> turns =
      map->way_at(orbit.place).turns(map->whole(orbit.state), orbit.period);
  std::ranges::sort(turns, [](const OrbitWay::Seen& a, const OrbitWay::Seen& b) {
    return std::fabs(a.level) * b.swing < std::fabs(b.level) * a.swing;
  });
  std::vector<Crossing> out;
  for (std::size_t i = 0; i < std::min(turns.size(), kMostTurns); ++i) {
    const OrbitWay::Seen& turn = turns[i];
    if (std::fabs(turn.level) > seed.near * turn.swing) break;
    const BorderScale scale = {orbit.sizes, {plane.range(0), plane.range(1)}, turn.swing};
    auto equations = std::make_unique<BorderEquations>(plane, map, BorderKind::grazing,
                                                       orbit.period, scale, turn.mark.limit);
    BorderPoint near;
    near.place = orbit.place;
    near.state = orbit.state;
    near.critical.moment = turn.mark.moment;
    const Eigen::VectorXd guess = equations->unknowns_of(near);
    Eigen::VectorXd across = Eigen::VectorXd::Zero(guess.size());
    across[guess.size() - 2] = -seed.way[1];
    across[guess.size() - 1] = seed.way[0];
    std::optional<BorderPoint> point =
        equations->correct(guess, across.normalized(), near.critical, kFarGraze);
    if (point) out.push_back({std::move(equations), *std::move(point)});
  }
  return out;
}

}  // namespace gearsweep
