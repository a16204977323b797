#include "borders/host_orbit_map.hpp"

#include <numeric>

namespace gearsweep {

HostOrbitMap::HostOrbitMap(const ParameterPlane& plane, std::size_t steps,
                           const std::atomic<bool>* stop)
    : plane_(plane), steps_(steps), stop_(stop) {
  const Model& model = *plane.model;
  const auto n = static_cast<Eigen::Index>(model.states.size());
  if (model.whole == nullptr) {
    kept_.resize(model.states.size());
    std::iota(kept_.begin(), kept_.end(), Eigen::Index{0});
    widen_ = Eigen::MatrixXd::Identity(n, n);
    return;
  }
  kept_.assign(model.reduction.kept.begin(), model.reduction.kept.end());
  widen_.setZero(static_cast<Eigen::Index>(model.whole->states.size()), n);
  for (Eigen::Index i = 0; i < n; ++i) widen_(kept_[static_cast<std::size_t>(i)], i) = 1.0;
  for (const MirrorPairs::Pair& pair : model.reduction.mirrors) {
    widen_.row(static_cast<Eigen::Index>(pair.second)) =
        -widen_.row(static_cast<Eigen::Index>(pair.first));
  }
}

std::vector<std::optional<OrbitAnswer>> HostOrbitMap::answer(
    const std::vector<OrbitQuery>& queries) {
  std::vector<std::optional<OrbitAnswer>> out;
  out.reserve(queries.size());
  for (const OrbitQuery& query : queries) out.push_back(answer_to(query));
  return out;
}

std::optional<OrbitAnswer> HostOrbitMap::answer_to(const OrbitQuery& query) const {
  OrbitWay way = way_at({query.values[0], query.values[1]});
  const std::size_t halves = query.is_half ? query.period : 2 * query.period;
  const std::optional<OrbitWay::End> end = way.go(
      {widen_ * query.state, query.needs_derivative ? widen_ : Eigen::MatrixXd(widen_.rows(), 0)},
      halves, query.graze);
  if (!end) return std::nullopt;
  const double sign = query.is_half ? -1.0 : 1.0;
  return OrbitAnswer{sign * end->motion.state(kept_),
                     sign * end->motion.tangents(kept_, Eigen::all), end->turn};
}

}  // namespace gearsweep
