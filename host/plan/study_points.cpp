#include "plan/study_points.hpp"

#include <fmt/format.h>

#include <random>

namespace gearsweep {
namespace {

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

std::vector<double> start_of_policy(const Study& study, const ModelSetting& setting) {
  switch (study.initial.policy) {
    case InitialPolicy::fixed:
      return study.initial.state;
    case InitialPolicy::shifted:
    case InitialPolicy::forward:  // of points without a neighbour to go on from
    case InitialPolicy::backward:
      break;
  }
  return study.model->equilibrium(setting);
}

StudyPoints::StudyPoints(std::shared_ptr<const Study> study) : study_(std::move(study)) {
  const Model& model = *study_->model;
  offsets_ = ensemble_offsets(study_->initial, model.full().states.size());
  for (const Swept* swept : study_->swept()) {
    if (!swept->is_state) differing_.push_back(swept->index);
  }
}

void StudyPoints::place_draw(std::size_t member, ModelSetting* setting) const {
  for (const UncertainParameter& parameter : study_->uncertain.parameters) {
    for (const Swept& swept : parameter.draws.swept()) {
      double& value = setting->parameters[swept.index];
      if (!parameter.is_factor) {
        value = member == 0 ? study_->setting.parameters[swept.index] : swept.values[member - 1];
        continue;
      }
      if (study_->find_on_axes(swept.index) == nullptr) {
        value = study_->setting.parameters[swept.index];
      }
      if (member > 0) value *= swept.values[member - 1];
    }
  }
}

void StudyPoints::set(std::size_t point, ModelSetting* setting) const {
  for (std::size_t axis = 0; axis < study_->axes.size(); ++axis) {
    const std::size_t index = study_->axis_index(axis, point);
    for (const Swept& swept : study_->axes[axis].swept()) {
      if (!swept.is_state) setting->parameters[swept.index] = swept.values[index];
    }
  }
  place_draw(point / study_->points(), setting);
  study_->model->derive(setting);
}

std::vector<double> StudyPoints::start(std::size_t point) const {
  ModelSetting setting = study_->setting;
  set(point, &setting);
  std::vector<double> state = start_of_policy(*study_, setting);
  const std::size_t member = point / study_->points();
  if (member < offsets_.size()) {
    for (std::size_t i = 0; i < state.size(); ++i) state[i] += offsets_[member][i];
  }
  for (std::size_t axis = 0; axis < study_->axes.size(); ++axis) {
    for (const Swept& swept : study_->axes[axis].swept()) {
      if (swept.is_state) state[swept.index] = swept.values[study_->axis_index(axis, point)];
    }
  }
  return state;
}

std::string StudyPoints::name(std::size_t point) const {
  if (const std::size_t draw = point / study_->points(); draw > 0) {
    return fmt::format("draw {} of [uncertain]", draw);
  }
  for (std::size_t axis = 0; axis < study_->axes.size(); ++axis) {
    if (study_->axes[axis].is_list) {
      return fmt::format("point {}", study_->axis_value(axis, point));
    }
  }
  return "";
}

std::size_t StudyPoints::stage_size(std::size_t stage) const {
  if (study_->is_chained() || stages() == 1) return size() / stages();
  return stage == 0 ? study_->points() : size() - study_->points();
}

std::size_t StudyPoints::point(std::size_t stage, std::size_t i) const {
  if (!study_->is_chained()) return stage == 0 ? i : study_->points() + i;
  const bool is_forward = info_of(study_->initial.policy).neighbour < 0;
  const std::size_t index = is_forward ? stage : stages() - 1 - stage;
  const std::size_t nx = study_->axes[0].values.size();
  return study_->initial.along == 0 ? i * nx + index : index * nx + i;
}

std::optional<std::size_t> StudyPoints::predecessor(std::size_t point) const {
  const int neighbour = info_of(study_->initial.policy).neighbour;
  if (neighbour == 0) {
    if (stages() == 1 || point < study_->points()) return std::nullopt;
    return point % study_->points();
  }
  const std::size_t along = study_->initial.along;
  const std::size_t index = study_->axis_index(along, point);
  const std::size_t first = neighbour < 0 ? 0 : stages() - 1;
  if (index == first) return std::nullopt;
  const std::size_t stride = along == 0 ? 1 : study_->axes[0].values.size();
  return neighbour < 0 ? point - stride : point + stride;
}

std::size_t StudyPoints::row() const {
  return study_->is_chained() && study_->initial.along == 0 ? 1 : study_->axes[0].values.size();
}

}  // namespace gearsweep
