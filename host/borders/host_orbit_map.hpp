// The orbit map of the host: period maps, whose steps are cut at every contact.
#pragma once

#include "borders/orbit_map.hpp"
#include "borders/parameter_plane.hpp"
#include "orbits/period_map.hpp"

namespace gearsweep {

class HostOrbitMap final : public OrbitMap {
 public:
  // At least `steps` steps per period. The plane must outlive it; its two parameters are those of
  // the map. stop: as in PeriodMap.
  HostOrbitMap(const ParameterPlane& plane, std::size_t steps,
               const std::atomic<bool>* stop = nullptr)
      : plane_(plane), steps_(steps), stop_(stop) {}

  std::vector<std::optional<OrbitAnswer>> answer(const std::vector<OrbitQuery>& queries) override;

  PeriodMap map_at(const PlanePlace& place) const {
    return {*plane_.model, plane_.setting_at(place), steps_, stop_};
  }

 private:
  const ParameterPlane& plane_;
  std::size_t steps_;
  const std::atomic<bool>* stop_;
};

}  // namespace gearsweep
