#include "cli/detail/exponent_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "plan/divergence.hpp"
#include "plan/plan.hpp"
#include "plan/unstable_start.hpp"

namespace gearsweep {
namespace {

constexpr double kLogOfSpeeds = 10.0;  // speeds on a bounded motion differ by no more than e^10
constexpr double kFarOff = 1e-3;       // of the divergence

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

std::optional<ExponentChecks> check_exponents(const SweepResult& result) {
  const std::vector<double>* const spectra = spectra_of(result);
  const Study& study = result.study;
  const std::size_t states = study.model->states.size();
  if (spectra == nullptr || spectra->size() != result.status.size() * states) return std::nullopt;
  const Plan plan(study, study.points());
  const Divergence divergence(study);
  const bool is_judged_by_zero = is_autonomous(study);
  ExponentChecks checks;
  if (is_judged_by_zero) checks.zero.emplace();
  for (std::size_t point = 0; point < result.status.size(); ++point) {
    const std::span<const double> spectrum(&(*spectra)[point * states], states);
    const auto is_finite = [](double value) { return std::isfinite(value); };
    if (!has_values(result.status[point]) || !std::ranges::all_of(spectrum, is_finite)) continue;
    ++checks.points;
    const ModelSetting setting = plan.setting_of(point);
    if (const std::optional<double> right = divergence.at(setting)) {
      double sum = 0.0;
      for (const double exponent : spectrum) sum += exponent;
      const double off = std::fabs(sum - *right);
      if (!checks.sum || off > checks.sum->off) checks.sum = SumCheck{off, *right};
    }
    const double time = study.model->period(setting) * static_cast<double>(study.integrate.record);
    const double near = kLogOfSpeeds / time;
    if (!is_judged_by_zero || std::ranges::max(spectrum) <= near) continue;
    ++checks.zero->judged;
    if (lacks_zero(spectrum, near)) ++checks.zero->lacking;
  }
  return checks;
}

std::string describe_exponent_checks(const SweepResult& result) {
  const std::optional<ExponentChecks> checks = check_exponents(result);
  if (!checks || checks->points == 0) return "";
  const char* const kShorter = "; shorter steps (integrate.max_step) may be needed";
  std::string text;
  if (checks->sum) {
    const SumCheck& sum = *checks->sum;
    text += fmt::format("spectra sum to the field's divergence, {:.6g}, to within {:.1e}{}\n",
                        sum.divergence, sum.off,
                        sum.off > kFarOff * std::fabs(sum.divergence) ? kShorter : "");
  }
  if (checks->zero && checks->zero->judged > 0) {
    const ZeroCheck& zero = *checks->zero;
    text += zero.lacking == 0
                ? fmt::format(
                      "{} spectra have a positive exponent and, as must be without "
                      "forcing, one that is 0\n",
                      zero.judged)
                : fmt::format(
                      "{} of {} spectra with a positive exponent have none that is 0, as "
                      "must be without forcing{}\n",
                      zero.lacking, zero.judged, kShorter);
  }
  return text;
}

nlohmann::json exponent_checks_as_json(const SweepResult& result) {
  const std::optional<ExponentChecks> checks = check_exponents(result);
  if (!checks) return nullptr;
  nlohmann::json json = {{"points", checks->points}};
  if (checks->sum) {
    json["sum_off"] = checks->sum->off;
    json["divergence"] = checks->sum->divergence;
  }
  if (checks->zero) {
    json["positive"] = checks->zero->judged;
    json["positive_without_zero"] = checks->zero->lacking;
  }
  return json;
}

}  // namespace gearsweep
