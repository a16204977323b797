#include "sweep/exponent_checks.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "plan/divergence.hpp"
#include "plan/plan.hpp"

namespace gearsweep {
namespace {

constexpr double kLogOfSpeeds = 10.0;  // speeds on a bounded motion differ by no more than e^10
constexpr double kFarOff = 1e-3;

const std::vector<double>* spectra_of(const SweepResult& result) {
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Quantity& quantity = result.study.selection.quantities[i];
    const bool is_plain = !quantity.divided_by && !quantity.of_draws;
    if (quantity.name == "lyapunov_spectrum" && is_plain) return &result.values[i];
  }
  return nullptr;
}

bool lacks_zero(std::span<const double> spectrum, double near) {
  return std::ranges::none_of(spectrum, [near](double value) { return std::fabs(value) <= near; });
}

}  // namespace

bool SumCheck::is_far_off() const {
  return off > kFarOff * std::max(std::fabs(divergence), largest);
}

std::optional<ExponentChecks> check_exponents(const SweepResult& result) {
  const std::vector<double>* const spectra = spectra_of(result);
  const Study& study = result.study;
  const std::size_t states = study.model->states.size();
  if (spectra == nullptr || spectra->size() != result.status.size() * states) return std::nullopt;
  const Plan plan(study, study.points());
  const Divergence divergence(study);
  const bool is_judged_by_zero = plan.is_autonomous();
  ExponentChecks checks;
  if (is_judged_by_zero) checks.zero.emplace();
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    const std::span<const double> spectrum(&(*spectra)[point * states], states);
    const auto is_finite = [](double value) { return std::isfinite(value); };
    if (!has_values(result.status[point]) || !std::ranges::all_of(spectrum, is_finite)) continue;
    ++checks.points;
    const ModelSetting setting = plan.setting_of(point);
    if (const std::optional<double> right = divergence.at(setting)) {
      double sum = 0.0, largest = 0.0;
      for (const double exponent : spectrum) {
        sum += exponent;
        largest = std::max(largest, std::fabs(exponent));
      }
      const double off = std::fabs(sum - *right);
      if (!checks.sum || off > checks.sum->off) {
        checks.sum = SumCheck{off, *right + 0.0, largest};  // no sign of a zero
      }
    }
    const double time = study.model->period(setting) * static_cast<double>(study.integrate.record);
    const double near = kLogOfSpeeds / time;
    if (!is_judged_by_zero || std::ranges::max(spectrum) <= near) continue;
    ++checks.zero->judged;
    if (lacks_zero(spectrum, near)) ++checks.zero->lacking;
  }
  return checks;
}

}  // namespace gearsweep
