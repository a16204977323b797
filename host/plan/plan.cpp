#include "plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include "model/error.hpp"

namespace gearsweep {
namespace {

constexpr double kMostSteps = 65536;  // per period

std::vector<std::size_t> all_points(std::size_t count) {
  std::vector<std::size_t> points(count);
  std::iota(points.begin(), points.end(), std::size_t{0});
  return points;
}

// The same for all points, so that neighbours differ by their parameters alone. The first is zero.
std::vector<std::vector<double>> ensemble_offsets(const Initial& initial, std::size_t states) {
  std::vector<std::vector<double>> offsets(initial.ensemble, std::vector<double>(states, 0.0));
  std::mt19937_64 random(initial.seed);
  for (std::size_t member = 1; member < offsets.size(); ++member) {
    for (std::size_t i = 0; i < states; ++i) {
      // Not std::uniform_real_distribution: its numbers differ between standard libraries.
      const double unit = static_cast<double>(random() >> 11U) * 0x1p-53;
      offsets[member][i] = initial.spread[i] * (2.0 * unit - 1.0);
    }
  }
  return offsets;
}

}  // namespace

Plan::Plan(const Study& study, std::size_t tile_points) : study_(study), tile_points_(tile_points) {
  for (const std::size_t point : all_points(study_.points())) {
    const std::string wrong = study_.model->check(setting_of(point));
    if (!wrong.empty()) throw InputError(wrong);
    steps_of(point);
  }
  offsets_ = ensemble_offsets(study_.initial, study_.model->states.size());
  if (!study_.is_chained()) {
    add_stage(all_points(study_.trajectories()));
    return;
  }
  const std::size_t length = study_.axes[study_.initial.along].values.size();
  for (std::size_t i = 0; i < length; ++i) {
    const std::size_t index = study_.initial.policy == InitialPolicy::forward ? i : length - 1 - i;
    const std::size_t nx = study_.axes[0].values.size();
    std::vector<std::size_t> points = all_points(study_.points() / length);
    for (std::size_t& point : points) {
      point = study_.initial.along == 0 ? point * nx + index : index * nx + point;
    }
    add_stage(points);
  }
}

double Plan::total_work() const {
  double work = 0.0;
  for (const Stage& stage : stages_) {
    for (const Tile& tile : stage.tiles) work += tile.work;
  }
  return work;
}

std::size_t Plan::axis_index(std::size_t axis, std::size_t point) const {
  const std::size_t nx = study_.axes[0].values.size();
  return axis == 0 ? point % nx : point % study_.points() / nx;
}

double Plan::axis_value(std::size_t axis, std::size_t point) const {
  return study_.axes[axis].values[axis_index(axis, point)];
}

ModelSetting Plan::setting_of(std::size_t point) const {
  ModelSetting setting = study_.setting;
  for (std::size_t axis = 0; axis < study_.axes.size(); ++axis) {
    if (study_.axes[axis].is_state) continue;
    setting.parameters[study_.axes[axis].index] = axis_value(axis, point);
  }
  return setting;
}

std::size_t Plan::steps_of(std::size_t point) const {
  if (study_.integrate.steps_per_period > 0) return study_.integrate.steps_per_period;
  const double wanted =
      study_.model->prepare(setting_of(point))->period() / study_.integrate.max_step;
  if (!(wanted <= kMostSteps)) {
    throw InputError(
        fmt::format("a period would take {:.3g} steps of at most {}; at most {} are "
                    "possible: raise integrate.max_step, or give "
                    "integrate.steps_per_period",
                    wanted, study_.integrate.max_step, kMostSteps));
  }
  return ladder_steps(wanted);
}

PhaseGrid Plan::phase_grid_of(std::size_t point) const {
  return make_phase_grid(*study_.model, setting_of(point), steps_of(point));
}

// The number of steps and the phase-shaping parameters among the axes.
std::vector<double> Plan::grid_key(std::size_t point) const {
  std::vector<double> key = {static_cast<double>(steps_of(point))};
  for (std::size_t axis = 0; axis < study_.axes.size(); ++axis) {
    const Axis& swept = study_.axes[axis];
    if (swept.is_state || !study_.model->parameters[swept.index].shapes_phase) continue;
    key.push_back(axis_value(axis, point));
  }
  return key;
}

std::optional<std::size_t> Plan::predecessor(std::size_t point) const {
  if (!study_.is_chained()) return std::nullopt;
  const std::size_t along = study_.initial.along;
  const std::size_t index = axis_index(along, point);
  const std::size_t stride = along == 0 ? 1 : study_.axes[0].values.size();
  if (study_.initial.policy == InitialPolicy::forward) {
    return index == 0 ? std::nullopt : std::optional(point - stride);
  }
  const bool last = index + 1 == study_.axes[along].values.size();
  return last ? std::nullopt : std::optional(point + stride);
}

std::vector<double> Plan::own_initial_state(std::size_t point) const {
  std::vector<double> state = study_.initial.policy == InitialPolicy::fixed
                                  ? study_.initial.state
                                  : study_.model->equilibrium(setting_of(point));
  const std::vector<double>& offset = offsets_[point / study_.points()];
  for (std::size_t i = 0; i < state.size(); ++i) state[i] += offset[i];
  for (std::size_t axis = 0; axis < study_.axes.size(); ++axis) {
    if (study_.axes[axis].is_state) state[study_.axes[axis].index] = axis_value(axis, point);
  }
  return state;
}

void Plan::add_stage(const std::vector<std::size_t>& points) {
  std::map<std::vector<double>, std::vector<std::size_t>> by_grid;
  for (const std::size_t point : points) by_grid[grid_key(point)].push_back(point);

  const auto periods =
      static_cast<double>(study_.integrate.settle) + static_cast<double>(study_.integrate.record);
  Stage stage;
  Tile tile;
  const auto close_tile = [&] {
    if (!tile.points.empty()) stage.tiles.push_back(std::move(tile));
    tile = {};
  };
  for (const auto& [key, members] : by_grid) {
    const double steps = key.front() * periods;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (tile.points.size() == tile_points_) close_tile();
      if (i == 0 || tile.points.empty()) tile.grid_starts.push_back(tile.points.size());
      tile.points.push_back(members[i]);
      tile.work += steps;
    }
  }
  close_tile();
  stages_.push_back(std::move(stage));
}

}  // namespace gearsweep
