#include "plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "model/error.hpp"
#include "plan/detail/structure.hpp"

namespace gearsweep {
namespace {

// Of a mesh period, and of a period of the forcing, which may be many of them.
constexpr double kMaxMeshSteps = 65536, kMaxSteps = 4194304;
// With fewer in a wave of an order Simpson's rule is off by more than (2 pi/8)^4/2880 = 1.3e-4 of
// what it integrates.
constexpr double kStepsOfWave = 8;

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

Plan::Plan(const Study& study, std::size_t tile_points)
    : shared_(std::make_shared<const Study>(study)), swept_(study_.swept()) {
  const Model& model = *study_.model;
  offsets_ = ensemble_offsets(study_.initial, (model.whole ? *model.whole : model).states.size());
  const Span x = {0, study_.axes[0].values.size()};
  const Span y = {0, study_.points() / x.last};
  const bool along_x = study_.initial.along == 0;
  const std::size_t length = (along_x ? x : y).last;
  const int neighbour = info_of(study_.initial.policy).neighbour;
  for (std::size_t i = 0; study_.is_chained() && i < length; ++i) {
    const std::size_t index = neighbour < 0 ? i : length - 1 - i;
    const Span here = {index, index + 1};
    groups_.push_back(along_x ? grouped(here, y) : grouped(x, here));
  }
  if (!study_.is_chained()) groups_.push_back(grouped(x, y));
  cut(tile_points);
}

void Plan::cut(std::size_t tile_points) {
  tile_points_ = tile_points;
  stages_.clear();
  for (const std::vector<Group>& groups : groups_) stages_.push_back(stage_of(groups));
}

bool Plan::is_autonomous() const {
  std::call_once(autonomy_->once, [this] {
    autonomy_->is_known_to_be = study_.model->is_autonomous || Structure(study_).is_autonomous();
  });
  return autonomy_->is_known_to_be;
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

void Plan::place(std::size_t axis, std::size_t index, ModelSetting* setting) const {
  if (axis >= study_.axes.size()) return;
  for (const Swept& swept : study_.axes[axis].swept()) {
    if (!swept.is_state) setting->parameters[swept.index] = swept.values[index];
  }
}

void Plan::place_draw(std::size_t member, ModelSetting* setting) const {
  for (const UncertainParameter& parameter : study_.uncertain.parameters) {
    for (const Swept& swept : parameter.draws.swept()) {
      double& value = setting->parameters[swept.index];
      if (!parameter.is_factor) {
        value = member == 0 ? study_.setting.parameters[swept.index] : swept.values[member - 1];
        continue;
      }
      if (study_.find_on_axes(swept.index) == nullptr) {
        value = study_.setting.parameters[swept.index];
      }
      if (member > 0) value *= swept.values[member - 1];
    }
  }
}

void Plan::set(std::size_t point, ModelSetting* setting) const {
  for (std::size_t axis = 0; axis < study_.axes.size(); ++axis) {
    place(axis, axis_index(axis, point), setting);
  }
  place_draw(point / study_.points(), setting);
}

ModelSetting Plan::setting_of(std::size_t point) const {
  ModelSetting setting = study_.setting;
  set(point, &setting);
  return setting;
}

Plan Plan::with_longer_steps() const {
  Plan longer = *this;
  longer.step_length_ = 2 * step_length_;
  return longer;
}

std::size_t Plan::steps_of(std::size_t point) const { return steps_at(setting_of(point)); }

double Plan::steps_of(const PointList& points, const std::vector<std::uint32_t>& periods) const {
  double steps = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    steps += static_cast<double>(periods[i] * steps_of(points[i]));
  }
  return steps;
}

std::size_t Plan::steps_at(const ModelSetting& setting) const {
  const auto longer = [this](std::size_t steps) {
    return (steps + step_length_ - 1) / step_length_;
  };
  const double for_orders = steps_for_orders(setting);
  const std::size_t given = study_.integrate.steps_per_period;
  if (given > 0) {
    if (static_cast<double>(given) >= for_orders) return longer(given);
    throw InputError(fmt::format(
        "the highest of observe.orders takes {} steps of a period or more, {} for each of its "
        "waves: integrate.steps_per_period = {} is too few",
        for_orders, kStepsOfWave, given));
  }
  const double wanted =
      std::max(study_.model->period(setting) / study_.integrate.max_step, for_orders);
  const double possible = std::min(kMaxSteps, kMaxMeshSteps * study_.model->mesh_periods(setting));
  if (!(wanted <= possible)) {
    throw InputError(fmt::format(
        "a period would take {:.3g} steps of at most {}{}; at most {} are "
        "possible: raise integrate.max_step, or give "
        "integrate.steps_per_period",
        wanted, study_.integrate.max_step,
        study_.step_reason.empty() ? "" : fmt::format(" ({})", study_.step_reason), possible));
  }
  return longer(study_.model->is_autonomous ? few_steps(wanted) : ladder_steps(wanted));
}

double Plan::steps_for_orders(const ModelSetting& setting) const {
  const std::vector<double>& orders = study_.selection.orders;
  if (orders.empty()) return 0.0;
  const double waves = *std::ranges::max_element(orders) * study_.model->mesh_periods(setting);
  return std::ceil(kStepsOfWave * waves);
}

PhaseGrid Plan::phase_grid_of(std::size_t point) const {
  return make_phase_grid(*study_.model, setting_of(point), steps_of(point));
}

std::vector<double> Plan::grid_key(std::size_t point) const {
  std::vector<double> key;
  set_key(setting_of(point), &key);
  return key;
}

// The number of steps and the phase-shaping parameters among those that differ.
void Plan::set_key(const ModelSetting& setting, std::vector<double>* key) const {
  key->assign(1, static_cast<double>(steps_at(setting)));
  for (const Swept* swept : swept_) {
    if (swept->is_state || !study_.model->parameters[swept->index].shapes_phase) continue;
    key->push_back(setting.parameters[swept->index]);
  }
}

std::optional<std::size_t> Plan::predecessor(std::size_t point) const {
  const int neighbour = info_of(study_.initial.policy).neighbour;
  if (neighbour == 0) return std::nullopt;
  const std::size_t along = study_.initial.along;
  const std::size_t index = axis_index(along, point);
  const std::size_t first = neighbour < 0 ? 0 : study_.axes[along].values.size() - 1;
  if (index == first) return std::nullopt;
  const std::size_t stride = along == 0 ? 1 : study_.axes[0].values.size();
  return neighbour < 0 ? point - stride : point + stride;
}

std::vector<double> Plan::start_of_policy(std::size_t point) const {
  switch (study_.initial.policy) {
    case InitialPolicy::fixed:
      return study_.initial.state;
    case InitialPolicy::shifted:
    case InitialPolicy::forward:  // of points without a neighbour to go on from
    case InitialPolicy::backward:
      break;
  }
  return study_.model->equilibrium(setting_of(point));
}

std::vector<double> Plan::own_initial_state(std::size_t point) const {
  std::vector<double> state = start_of_policy(point);
  const std::size_t member = point / study_.points();
  if (member < offsets_.size()) {
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += offsets_[member][i];
  }
  for (std::size_t axis = 0; axis < study_.axes.size(); ++axis) {
    for (const Swept& swept : study_.axes[axis].swept()) {
      if (swept.is_state) state[swept.index] = swept.values[axis_index(axis, point)];
    }
  }
  return study_.model->own_state(state);
}

void Plan::refuse(std::size_t point, const std::string& wrong) const {
  if (const std::size_t draw = point / study_.points(); draw > 0) {
    throw InputError(fmt::format("draw {} of [uncertain]: {}", draw, wrong));
  }
  for (std::size_t axis = 0; axis < study_.axes.size(); ++axis) {
    if (!study_.axes[axis].is_list) continue;
    throw InputError(fmt::format("point {}: {}", axis_value(axis, point), wrong));
  }
  throw InputError(wrong);
}

// A study is refused here, not when a tile of it is made.
void Plan::check_breaks(std::size_t point, const ModelSetting& setting) const {
  try {
    study_.model->break_phases(setting);
  } catch (const InputError& error) {
    refuse(point, error.what());
  }
}

// In the order of their keys. What takes time for each point of a large study is here.
std::vector<Plan::Group> Plan::grouped(const Span& x, const Span& y) const {
  std::map<std::vector<double>, PointList> by_grid;
  using Entry = decltype(by_grid)::value_type;
  // Mostly a point shares the grid of the one before it, or of the one in the row before.
  Entry* entry = nullptr;
  std::vector<Entry*> row(x.last - x.first, nullptr);
  std::vector<double> key;
  ModelSetting setting = study_.setting;
  const std::size_t nx = study_.axes[0].values.size();
  const std::size_t members = study_.is_chained() ? 1 : study_.members();
  const bool has_draws = !study_.uncertain.parameters.empty();
  for (std::size_t line = 0; line < members * (y.last - y.first); ++line) {
    const std::size_t member = line / (y.last - y.first);
    const std::size_t iy = y.first + line % (y.last - y.first);
    place(1, iy, &setting);
    for (std::size_t ix = x.first; ix < x.last; ++ix) {
      if (has_draws) {
        set(member * study_.points() + iy * nx + ix, &setting);
      } else {
        place(0, ix, &setting);
      }
      const std::string wrong = study_.model->check(setting);
      if (!wrong.empty()) refuse(member * study_.points() + iy * nx + ix, wrong);
      set_key(setting, &key);
      Entry*& above = row[ix - x.first];
      if (entry == nullptr || entry->first != key) entry = above;
      if (entry == nullptr || entry->first != key) {
        const auto [place, is_new] = by_grid.try_emplace(key);
        if (is_new) check_breaks(member * study_.points() + iy * nx + ix, setting);
        entry = &*place;
      }
      above = entry;
      entry->second.push_back(member * study_.points() + iy * nx + ix);
    }
  }
  std::vector<Group> groups;
  for (auto& [grid, points] : by_grid) groups.push_back({grid.front(), std::move(points)});
  return groups;
}

Stage Plan::stage_of(const std::vector<Group>& groups) const {
  const auto periods =
      static_cast<double>(study_.integrate.settle) + static_cast<double>(study_.integrate.record);
  Stage stage;
  Tile tile;
  const auto close_tile = [&] {
    if (!tile.points.empty()) stage.tiles.push_back(std::move(tile));
    tile = {};
  };
  for (const Group& group : groups) {
    bool is_first = true;
    for (const std::size_t point : group.points) {
      if (tile.points.size() == tile_points_) close_tile();
      if (is_first || tile.points.empty()) tile.grid_starts.push_back(tile.points.size());
      is_first = false;
      tile.points.push_back(point);
      tile.work += group.steps * periods;
    }
  }
  close_tile();
  return stage;
}

std::vector<const Tile*> tiles_of(const Plan& plan) {
  std::vector<const Tile*> tiles;
  for (const Stage& stage : plan.stages()) {
    for (const Tile& tile : stage.tiles) tiles.push_back(&tile);
  }
  return tiles;
}

}  // namespace gearsweep
