#include "borders/device_orbit_map.hpp"

#include <algorithm>
#include <numeric>

#include "borders/query_points.hpp"
#include "orbits/period_map.hpp"
#include "plan/plan.hpp"

namespace gearsweep {
namespace {

std::vector<std::size_t> parameters_of(const Study& study) {
  std::vector<std::size_t> out;
  for (const Axis& axis : study.axes) out.push_back(axis.index);
  return out;
}

}  // namespace

DeviceOrbitMap::DeviceOrbitMap(std::shared_ptr<const Study> study, Engine* engine,
                               const std::atomic<bool>* stop)
    : study_(std::move(study)), engine_(engine), stop_(stop) {}

std::vector<std::optional<OrbitAnswer>> DeviceOrbitMap::answer(
    const std::vector<OrbitQuery>& queries) {
  // Those of equal length stand together: lanes of a work-item take as long as the longest.
  std::vector<std::size_t> order(queries.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return queries[a].period < queries[b].period; });
  std::vector<OrbitQuery> sorted;
  for (const std::size_t query : order) sorted.push_back(queries[query]);
  const auto points =
      std::make_shared<const QueryPoints>(*study_->model, parameters_of(*study_), sorted);
  const Plan plan(study_, points, queries.size());

  const std::lock_guard lock(mutex_);
  const RoundCallback may_go_on = [this](double) { return stop_ == nullptr || !*stop_; };
  const std::size_t states = study_->model->states.size();
  const auto n = static_cast<Eigen::Index>(states);
  std::vector<std::optional<OrbitAnswer>> out(queries.size());
  for (const Tile& tile : plan.stages().front().tiles) {
    std::vector<double> starts;
    std::vector<std::uint32_t> lengths;
    for (const std::size_t point : tile.points) {
      append(points->start(point), &starts);
      lengths.push_back(static_cast<std::uint32_t>(sorted[point].period));
    }
    const std::optional<ReturnMaps> maps =
        engine_->orbits()->return_maps(plan, tile, starts, lengths, may_go_on);
    if (!maps) throw SearchStopped();
    for (std::size_t i = 0; i < tile.points.size(); ++i) {
      OrbitAnswer answer;
      answer.image = Eigen::VectorXd::Map(maps->states.data() + i * states, n);
      answer.derivative =
          Eigen::MatrixXd::Map(maps->derivatives.data() + i * states * states, n, n);
      if (!study_->model->is_within_limits({answer.image.data(), states}) ||
          !answer.derivative.allFinite()) {
        continue;
      }
      out[order[tile.points[i]]] = std::move(answer);
    }
  }
  return out;
}

}  // namespace gearsweep
