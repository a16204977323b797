#include "report/detail/speeds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/exciting_meshes.hpp"
#include "report/detail/html.hpp"
#include "result/order_dataset.hpp"

namespace gearsweep {
namespace {

// What frequencies are counted in where there are no scales.
std::string plain_unit(const Model& model) {
  const bool has_scales = model.states.front().unit == "b_n";
  return has_scales ? " ϖ" : "";
}

std::vector<CriticalSpeed> critical_speeds(const ReportFindings& findings) {
  std::vector<CriticalSpeed> speeds;
  for (const ReportMode& mode : distinct_modes(findings)) {
    for (const ExcitationOrder& order : excitation_orders(findings)) {
      speeds.push_back({mode.frequency / order.order, mode.frequency, order});
    }
  }
  return speeds;
}

// Half orders need a motion of two periods, so they are met where the teeth part.
bool is_of_half(const CriticalSpeed& one) { return one.order.is_half; }

std::vector<ExcitingMesh> meshes_of(const ReportFindings& findings) {
  return exciting_meshes(*findings.line.model, findings.line.setting);
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
  if (scales.known()) return html_number(frequency * hertz_per_unit(scales)) + " Hz";
  return fmt::format("{:.4g}{}", frequency, plain_unit(*findings.study.model));
}

std::string speed_html(const ReportFindings& findings, double forcing) {
  const Scales& scales = findings.study.scales;
  if (scales.known()) return fmt::format("{:.0f} rpm", forcing * scales.rpm_per_omega);
  return frequency_html(findings, forcing);
}

std::vector<ExcitationOrder> excitation_orders(const ReportFindings& findings) {
  const std::vector<ExcitingMesh> meshes = meshes_of(findings);
  std::vector<ExcitationOrder> orders;
  for (const ExcitingMesh& mesh : meshes) {
    const std::string whose = meshes.size() == 1 ? "" : " of " + mesh.name;
    for (const auto& [name, order] : {std::pair("1", 1.0), {"2", 2.0}, {"3", 3.0}, {"1/2", 0.5}}) {
      orders.push_back({name + whose, order * mesh.order, order < 1.0});
    }
  }
  return orders;
}

std::string rays_html(const ReportFindings& findings) {
  const std::vector<ExcitingMesh> meshes = meshes_of(findings);
  if (meshes.size() == 1) return "dotted: orders of the mesh frequency";
  return fmt::format(
      "orange, dotted: orders of the mesh frequency of {}; violet, dashed: those of {}",
      html_text(meshes.front().name), html_text(meshes.back().name));
}

std::string CriticalSpeed::html(const ReportFindings& findings) const {
  const char* const link = meshes_of(findings).size() == 1 ? "of" : "at";
  return fmt::format("order {} {} {}", html_text(order.name), link,
                     frequency_html(findings, frequency));
}

std::optional<CriticalSpeed> nearest_critical(const ReportFindings& findings, double forcing,
                                              bool with_halves) {
  const auto distance = [&](const CriticalSpeed& one) { return std::abs(one.margin(forcing)); };
  std::vector<CriticalSpeed> speeds = critical_speeds(findings);
  if (!with_halves) std::erase_if(speeds, is_of_half);
  const auto nearest = std::ranges::min_element(speeds, {}, distance);
  return nearest == speeds.end() ? std::nullopt : std::optional(*nearest);
}

std::optional<CriticalSpeed> next_critical(const ReportFindings& findings, double forcing,
                                           double near) {
  std::optional<CriticalSpeed> next;
  for (const CriticalSpeed& one : critical_speeds(findings)) {
    const bool is_above = one.margin(forcing) > near && !is_of_half(one);
    if (is_above && (!next || one.forcing < next->forcing)) next = one;
  }
  return next;
}

std::string resonance_html(const ReportFindings& findings, double forcing) {
  const std::optional<CriticalSpeed> nearest = nearest_critical(findings, forcing, true);
  if (!nearest || std::abs(nearest->margin(forcing)) >= kNearSpeeds) return "";
  // Seen from the critical speed, which lies above where this one is below it.
  const double off = forcing / nearest->forcing - 1.0;
  return fmt::format("{}, {} {}", nearest->html(findings), html_percent(std::abs(off)),
                     off < 0.0 ? "below" : "above");
}

std::string margin_html(const CriticalSpeed& critical, double from) {
  const double margin = critical.margin(from);
  return fmt::format("{} {}", html_percent(std::abs(margin)), margin < 0.0 ? "lower" : "higher");
}

}  // namespace gearsweep
