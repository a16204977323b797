// The orbit map of the host: period maps, whose steps are cut at every contact.
#pragma once

#include <vector>

#include "borders/orbit_map.hpp"
#include "borders/orbit_way.hpp"
#include "borders/parameter_plane.hpp"
#include "orbits/period_map.hpp"

namespace gearsweep {

class HostOrbitMap final : public OrbitMap {
 public:
  // At least `steps` steps per period. The plane must outlive it; its two parameters are those of
  // the map. Of a reduced model, states are those that are kept. stop: as in PeriodMap.
  HostOrbitMap(const ParameterPlane& plane, std::size_t steps,
               const std::atomic<bool>* stop = nullptr);

  std::vector<std::optional<OrbitAnswer>> answer(const std::vector<OrbitQuery>& queries) override;

  // The map of the whole model.
  PeriodMap map_at(const PlanePlace& place) const {
    return {plane_.model->full(), plane_.setting_at(place), steps_, stop_};
  }
  OrbitWay way_at(const PlanePlace& place) const {
    return {plane_.model->full(), plane_.setting_at(place), steps_, stop_};
  }
  // A state of the whole model; what drives nothing is 0.
  Eigen::VectorXd whole(const Eigen::VectorXd& state) const { return widen_ * state; }
  const std::vector<Eigen::Index>& kept() const { return kept_; }

 private:
  std::optional<OrbitAnswer> answer_to(const OrbitQuery& query) const;

  const ParameterPlane& plane_;
  std::size_t steps_;
  const std::atomic<bool>* stop_;
  std::vector<Eigen::Index> kept_;  // states of the whole model
  Eigen::MatrixXd widen_;           // makes a whole state of one that is kept
};

}  // namespace gearsweep
