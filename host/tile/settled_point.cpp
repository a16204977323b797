#include "tile/settled_point.hpp"

#include "tile/detail/orbit_search.hpp"

namespace gearsweep {

std::optional<SettledPoint> settle_point(const Plan& plan, const Plan& orbit_plan,
                                         std::size_t point, const std::vector<double>& initial,
                                         Engine* engine, const RoundCallback& after_round) {
  const std::size_t settle = plan.study().integrate.settle;
  const Tile tile = {{point}, {0}, 0.0};
  OrbitSearch search(plan, orbit_plan, tile, initial, searched_periods(plan.study()),
                     engine->orbits());
  while (search.can_advance()) {
    if (!search.advance(after_round)) return std::nullopt;
    if (search.found().empty()) continue;
    const FoundOrbit& orbit = search.found().front();
    return SettledPoint{orbit.state, orbit.settled, (settle - orbit.settled) % orbit.length,
                        orbit.length};
  }
  if (!search.diverged().empty()) return SettledPoint{};
  return SettledPoint{search.states(), search.settled(), settle - search.settled(), 0};
}

}  // namespace gearsweep
