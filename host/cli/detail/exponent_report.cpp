#include "cli/detail/exponent_report.hpp"

#include <fmt/format.h>

#include <optional>

#include "sweep/exponent_checks.hpp"

namespace gearsweep {
namespace {

constexpr const char* kShorter = "; shorter steps (integrate.max_step) may be needed";

}  // namespace

std::string describe_exponent_checks(const SweepResult& result) {
  const std::optional<ExponentChecks> checks = check_exponents(result);
  if (!checks || checks->points == 0) return "";
  std::string text;
  if (checks->sum) {
    const SumCheck& sum = *checks->sum;
    text += fmt::format("spectra sum to the field's divergence, {:.6g}, to within {:.1e}{}\n",
                        sum.divergence, sum.off, sum.is_far_off() ? kShorter : "");
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
