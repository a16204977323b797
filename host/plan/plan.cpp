#include "plan/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "model/error.hpp"
#include "plan/detail/structure.hpp"
#include "plan/study_points.hpp"

namespace gearsweep {
namespace {

// Steps of a mesh period, and of a period of the forcing, which may be many of them.
constexpr double kMaxMeshSteps = 65536, kMaxSteps = 4194304;
// With fewer in a wave of an order Simpson's rule is off by more than (2 pi/8)^4/2880 = 1.3e-4 of
// what it integrates.
constexpr double kStepsOfWave = 8;

// Whether the rates of the states that are kept are others at another phase: then the equations
// have it, and their graph need not be made to tell.
bool differs_at_another_phase(const Model& model, const ModelSetting& setting) {
  const Model& whole = model.full();
  const std::vector<double> state(whole.states.size(), 0.5);
  std::vector<double> coefs(whole.phase_coefs.size());
  const auto point = whole.prepare(setting);
  const auto rates_at = [&](double phase) {
    std::vector<double> rates(state.size());
    whole.phase_coefs_at(setting, phase, 1e-9, coefs.data());
    point->rhs(coefs.data(), state.data(), rates.data());
    return rates;
  };
  const std::vector<double> one = rates_at(0.0), other = rates_at(0.3);
  std::vector<std::size_t> kept = model.reduction.kept;
  for (std::size_t i = 0; model.whole == nullptr && i < one.size(); ++i) kept.push_back(i);
  return std::ranges::any_of(kept, [&](std::size_t i) {
    return std::isfinite(one[i]) && std::isfinite(other[i]) && one[i] != other[i];
  });
}

// Compares keys of grids, whose last number is that of their steps.
bool have_one_shape(const std::vector<double>& one, const std::vector<double>& other) {
  return std::equal(one.begin(), one.end() - 1, other.begin());
}

}  // namespace

Plan::Plan(const Study& study, std::size_t tile_points)
    : Plan(std::make_shared<const Study>(study), nullptr, tile_points) {}

Plan::Plan(std::shared_ptr<const Study> study, std::shared_ptr<const PointSource> points,
           std::size_t tile_points)
    : shared_(std::move(study)),
      points_(points ? std::move(points) : std::make_shared<const StudyPoints>(shared_)) {
  shared_steps_ = shared_steps_of_study();
  for (std::size_t stage = 0; stage < points_->stages(); ++stage) {
    groups_.push_back(groups_of(stage));
  }
  cut(tile_points);
}

Plan::Plan(const Plan& other, std::size_t step_length, std::size_t step_parts)
    : autonomy_(other.autonomy_),
      shared_(other.shared_),
      points_(other.points_),
      tile_points_(other.tile_points_),
      shared_steps_(other.shared_steps_),
      step_length_(step_length),
      step_parts_(step_parts) {}

void Plan::cut(std::size_t tile_points) {
  tile_points_ = tile_points;
  stages_.clear();
  for (const std::vector<Group>& groups : groups_) stages_.push_back(stage_of(groups));
}

bool Plan::is_autonomous() const {
  std::call_once(autonomy_->once, [this] {
    autonomy_->is_known_to_be =
        study_.model->is_autonomous || (study_.model->surfaces.empty() &&
                                        !differs_at_another_phase(*study_.model, setting_of(0)) &&
                                        Structure(study_).is_autonomous());
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

ModelSetting Plan::setting_of(std::size_t point) const {
  ModelSetting setting = study_.setting;
  points_->set(point, &setting);
  return setting;
}

Plan Plan::with_longer_steps() const { return {*this, 2 * step_length_, step_parts_}; }

Plan Plan::with_shorter_steps(std::size_t parts) const {
  return {*this, step_length_, parts * step_parts_};
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
  const auto in_own_steps = [this](std::size_t steps) {
    return (steps * step_parts_ + step_length_ - 1) / step_length_;
  };
  const double for_orders = steps_for_orders(setting);
  const auto parts = static_cast<double>(study_.integrate.orbit_steps);
  const double possible =
      std::min(kMaxSteps, kMaxMeshSteps * study_.model->mesh_periods(setting)) / parts;
  const std::size_t given = study_.integrate.steps_per_period;
  if (given > 0) {
    if (static_cast<double>(given) * parts > kMaxSteps) {
      throw InputError(fmt::format(
          "integrate.steps_per_period = {} and integrate.orbit_steps = {} make {} steps of a "
          "period on an orbit; at most {} are possible",
          given, parts, static_cast<double>(given) * parts, kMaxSteps));
    }
    if (static_cast<double>(given) >= for_orders) return in_own_steps(given);
    throw InputError(fmt::format(
        "the highest of observe.orders takes {} steps of a period or more, {} for each of its "
        "waves: integrate.steps_per_period = {} is too few",
        for_orders, kStepsOfWave, given));
  }
  const double wanted =
      std::max(study_.model->period(setting) / study_.integrate.max_step, for_orders);
  if (!(wanted <= possible)) {
    throw InputError(
        fmt::format("a period would take {:.3g} steps of at most {}{}; at most {} are possible{}: "
                    "{} integrate.max_step, or give integrate.steps_per_period",
                    wanted, study_.integrate.max_step,
                    study_.step_reason.empty() ? "" : fmt::format(" ({})", study_.step_reason),
                    std::floor(possible),
                    parts > 1.0 ? fmt::format(" with integrate.orbit_steps = {}", parts) : "",
                    study_.step_reason.empty() ? "raise" : "give a longer"));
  }
  if (study_.model->is_autonomous) return in_own_steps(few_steps(wanted));
  return in_own_steps(shared_steps_.at_least(ladder_steps(wanted)));
}

// Tells a study whose draws have phase tables of their own, each one for all values of its axes,
// and start from the nominal motion: draws with starts of their own are, to the bit, the points of
// a study of these parameters. The rule knows no engine: shards of a study run on several.
SharedSteps Plan::shared_steps_of_study() const {
  const auto shapes_phase = [this](const Axis& axis) {
    return std::ranges::any_of(axis.swept(), [this](const Swept& one) {
      return !one.is_state && study_.model->parameters[one.index].shapes_phase;
    });
  };
  const bool have_own_tables =
      std::ranges::any_of(study_.uncertain.parameters,
                          [&](const UncertainParameter& one) { return shapes_phase(one.draws); });
  if (!study_.uncertain.starts_at_nominal || !have_own_tables) return {};
  if (std::ranges::any_of(study_.axes, shapes_phase)) return {};
  const StudyPoints nominal(shared_);
  ModelSetting setting = study_.setting;
  std::vector<std::size_t> steps;
  for (std::size_t point = 0; point < study_.points(); ++point) {
    nominal.set(point, &setting);
    steps.push_back(steps_at(setting));
  }
  return SharedSteps(std::move(steps));
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

// The phase-shaping parameters among those that differ, and the number of steps: so what follows
// from the parameters alone is asked for grid by grid.
void Plan::set_key(const ModelSetting& setting, std::vector<double>* key) const {
  key->clear();
  for (const std::size_t parameter : points_->differing()) {
    if (!study_.model->parameters[parameter].shapes_phase) continue;
    key->push_back(setting.parameters[parameter]);
  }
  key->push_back(static_cast<double>(steps_at(setting)));
}

std::vector<double> Plan::own_initial_state(std::size_t point) const {
  return study_.model->own_state(points_->start(point));
}

void Plan::refuse(std::size_t point, const std::string& wrong) const {
  const std::string name = points_->name(point);
  throw InputError(name.empty() ? wrong : fmt::format("{}: {}", name, wrong));
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
std::vector<Plan::Group> Plan::groups_of(std::size_t stage) const {
  std::map<std::vector<double>, PointList> by_grid;
  using Entry = decltype(by_grid)::value_type;
  Entry* entry = nullptr;
  std::vector<Entry*> row(points_->row(), nullptr);
  std::vector<double> key;
  ModelSetting setting = study_.setting;
  const std::size_t size = points_->stage_size(stage);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t point = points_->point(stage, i);
    points_->set(point, &setting);
    const std::string wrong = study_.model->check(setting);
    if (!wrong.empty()) refuse(point, wrong);
    set_key(setting, &key);
    Entry*& above = row[i % row.size()];
    if (entry == nullptr || entry->first != key) entry = above;
    if (entry == nullptr || entry->first != key) {
      const auto [place, is_new] = by_grid.try_emplace(key);
      // The map has keys of one shape beside each other, and the first of them was checked.
      const auto is_first = [&, at = place] {
        return (at == by_grid.begin() || !have_one_shape(std::prev(at)->first, key)) &&
               (std::next(at) == by_grid.end() || !have_one_shape(std::next(at)->first, key));
      };
      if (is_new && is_first()) check_breaks(point, setting);
      entry = &*place;
    }
    above = entry;
    entry->second.push_back(point);
  }
  std::vector<Group> groups;
  for (auto& [grid, points] : by_grid) groups.push_back({grid.back(), std::move(points)});
  return groups;
}

Stage Plan::stage_of(const std::vector<Group>& groups) const {
  struct Part {  // of a group
    double steps;
    PointList::Iterator first;
    std::size_t count;
  };
  const auto periods =
      static_cast<double>(study_.integrate.settle) + static_cast<double>(study_.integrate.record);
  Stage stage;
  std::vector<Part> parts;
  std::size_t open = tile_points_;  // what the tile has room for
  const auto close_tile = [&] {
    if (parts.empty()) return;
    std::ranges::stable_sort(parts, {}, &Part::steps);
    Tile tile;
    for (const Part& part : parts) {
      tile.grid_starts.push_back(tile.points.size());
      PointList::Iterator point = part.first;
      for (std::size_t i = 0; i < part.count; ++i) tile.points.push_back(*point++);
      tile.work += part.steps * periods * static_cast<double>(part.count);
    }
    stage.tiles.push_back(std::move(tile));
    parts.clear();
    open = tile_points_;
  };
  for (const Group& group : groups) {
    PointList::Iterator point = group.points.begin();
    for (std::size_t rest = group.points.size(); rest > 0;) {
      const std::size_t count = std::min(open, rest);
      parts.push_back({group.steps, point, count});
      for (std::size_t i = 0; i < count; ++i) ++point;
      rest -= count;
      open -= count;
      if (open == 0) close_tile();
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
