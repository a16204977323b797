#include "plan/step_check.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "model/eigenvalues.hpp"
#include "plan/detail/local_field.hpp"
#include "study/own_step.hpp"

namespace gearsweep {
namespace {

constexpr double kFaster = 1.25;  // times the fastest rate that the step was found by
constexpr double kShorter = 0.8;  // times the point's step

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

double rate_of(const std::vector<double>& jacobian, std::size_t states) {
  if (!std::ranges::all_of(jacobian, [](double slope) { return std::isfinite(slope); })) return 0.0;
  double rate = 0.0;
  // A transposed matrix has the same eigenvalues.
  for (const std::complex<double>& value : eigenvalues(jacobian.data(), states)) {
    rate = std::max(rate, std::abs(value));
  }
  return rate;
}

}  // namespace

bool has_outgrown_step(const Plan& plan, std::size_t point, const std::vector<double>& state) {
  const Study& study = plan.study();
  if (study.step_reach.low.empty()) return false;
  const Model& model = *study.model;
  const std::vector<double> whole = whole_state(model, state);
  if (!is_beyond(study.step_reach, model, whole)) return false;
  const ModelSetting setting = plan.setting_of(point);
  const double rate = rate_of(local_field_at(model, setting, state).jacobian, state.size());
  if (rate <= kFaster * study.step_reach.rate) return false;
  const double step = model.period(setting) / static_cast<double>(plan.steps_of(point));
  return step_wanted_at(model.full(), setting, whole) < kShorter * step;
}

}  // namespace gearsweep
