#include "borders/host_orbit_map.hpp"

namespace gearsweep {

std::vector<std::optional<OrbitAnswer>> HostOrbitMap::answer(
    const std::vector<OrbitQuery>& queries) {
  std::vector<std::optional<OrbitAnswer>> out;
  out.reserve(queries.size());
  for (const OrbitQuery& query : queries) {
    const PeriodMap map = map_at({query.values[0], query.values[1]});
    std::optional<PeriodImage> image = map.linearize(query.state, query.period);
    if (image) {
      out.push_back(OrbitAnswer{std::move(image->state), std::move(image->monodromy)});
    } else {
      out.push_back(std::nullopt);
    }
  }
  return out;
}

}  // namespace gearsweep
