#include "plan/step_check.hpp"

#include <algorithm>

#include "study/own_step.hpp"

namespace gearsweep {
namespace {

// Times the point's step. The error of a step grows with the fifth power: it is a hundred times
// what was asked for.
constexpr double kShorter = 0.4;

// States that are left out and drive nothing stay 0; mirrored ones mirror.
std::vector<double> whole_state(const Model& model, const std::vector<double>& own) {
  if (model.whole == nullptr) return own;
  std::vector<double> whole(model.full().states.size());
  for (std::size_t i = 0; i < own.size(); ++i) whole[model.reduction.kept[i]] = own[i];
  for (const MirrorPairs::Pair& pair : model.reduction.mirrors) {
    whole[pair.second] = -whole[pair.first];
  }
  return whole;
}

// By more than the way from one end of it to the other. Of the states that the model has.
bool is_beyond(const MotionReach& reach, const Model& model, const std::vector<double>& whole) {
  const auto leaves = [&](std::size_t i) {
    const double width = reach.high[i] - reach.low[i];
    return whole[i] < reach.low[i] - width || whole[i] > reach.high[i] + width;
  };
  if (model.whole != nullptr) return std::ranges::any_of(model.reduction.kept, leaves);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (leaves(i)) return true;
  }
  return false;
}

}  // namespace

bool has_outgrown_step(const Plan& plan, std::size_t point, const std::vector<double>& state) {
  const Study& study = plan.study();
  if (study.step_reach.low.empty()) return false;
  const Model& model = *study.model;
  const std::vector<double> whole = whole_state(model, state);
  if (!is_beyond(study.step_reach, model, whole)) return false;
  const ModelSetting setting = plan.setting_of(point);
  const double step = model.period(setting) / static_cast<double>(plan.steps_of(point));
  return step_of_error_at(model.full(), setting, whole) < kShorter * step;
}

}  // namespace gearsweep
