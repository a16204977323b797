#include "report/detail/speeds.hpp"

#include <fmt/format.h>

#include <cmath>

#include "report/detail/html.hpp"
#include "result/order_dataset.hpp"

namespace gearsweep {
namespace {

// What frequencies are counted in where there are no scales.
std::string plain_unit(const Model& model) {
  const bool has_scales = model.states.front().unit == "b_n";
  return has_scales ? " ϖ" : "";
}

}  // namespace

std::vector<ReportMode> distinct_modes(const ReportFindings& findings) {
  constexpr double kSame = 1e-6;
  std::vector<ReportMode> modes;
  for (const NaturalMode& mode : findings.orders.modes.front()) {
    if (!modes.empty() && mode.frequency - modes.back().frequency < kSame * mode.frequency) {
      ++modes.back().count;
    } else {
      modes.push_back({mode.frequency, mode.damping, 1});
    }
  }
  return modes;
}

std::string frequency_html(const ReportFindings& findings, double frequency) {
  const Scales& scales = findings.study.scales;
  if (scales.known()) return fmt::format("{:.4g} Hz", frequency * hertz_per_unit(scales));
  return fmt::format("{:.4g}{}", frequency, plain_unit(*findings.study.model));
}

std::string speed_html(const ReportFindings& findings, double forcing) {
  const Scales& scales = findings.study.scales;
  if (scales.known()) return fmt::format("{:.0f} rpm", forcing * scales.rpm_per_omega);
  return frequency_html(findings, forcing);
}

const std::vector<ExcitationOrder>& excitation_orders() {
  static const std::vector<ExcitationOrder> kExcitationOrders = {
      {"1", 1.0}, {"2", 2.0}, {"3", 3.0}, {"1/2", 0.5}};
  return kExcitationOrders;
}

std::string resonance_html(const ReportFindings& findings, double forcing) {
  constexpr double kNear = 0.05;
  double nearest = kNear;
  std::string found;
  for (const ReportMode& mode : distinct_modes(findings)) {
    for (const ExcitationOrder& order : excitation_orders()) {
      const double off = order.order * forcing / mode.frequency - 1.0;
      if (std::abs(off) >= nearest) continue;
      nearest = std::abs(off);
      found = fmt::format("order {} of {}, {:.1f} % {}", order.name,
                          frequency_html(findings, mode.frequency), 100.0 * std::abs(off),
                          off < 0.0 ? "below" : "above");
    }
  }
  return found;
}

}  // namespace gearsweep
