#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "report/detail/figures.hpp"
#include "report/detail/names.hpp"
#include "report/detail/sections.hpp"
#include "report/detail/speeds.hpp"
#include "study/draw_quantities.hpp"

namespace gearsweep {
namespace {

constexpr const char* kBothFlanks = "contact_class_double_sided_share";

bool tells_flanks(const ReportFindings& findings) {
  return std::ranges::any_of(draw_quantities(*findings.tolerances), [](const DrawQuantity& drawn) {
    return drawn.quantity.name == kBothFlanks;
  });
}

// Where both flanks are hit most often; empty where they never are.
std::string worst_share_html(const ReportFindings& findings) {
  const ResultMap share = findings.over_speed("tolerances.nc", kBothFlanks);
  double worst_share = 0.0, worst_forcing = 0.0;
  for (std::size_t point = 0; point < share.values.size(); ++point) {
    if (!(share.values[point] > worst_share)) continue;
    worst_share = share.values[point];
    worst_forcing = findings.orders.forcing[point];
  }
  if (worst_share == 0.0) return "";
  return fmt::format("{}Both flanks are hit most often at {}: in {} of the draws.",
                     findings.name.empty() ? "" : html_text(findings.name) + ": ",
                     speed_html(findings, worst_forcing), html_percent(worst_share));
}

}  // namespace

void add_tolerances(const Sides& sides, HtmlPage* page) {
  const auto has_none = [](const ReportFindings& findings) { return !findings.tolerances; };
  if (std::ranges::any_of(sides, has_none)) return;
  const ReportFindings& first = sides.front();
  page->heading("Tolerances");
  std::vector<std::string> names;
  for (const UncertainParameter& parameter : first.tolerances->uncertain.parameters) {
    names.push_back(html_text(parameter.draws.name));
  }
  std::vector<HtmlFigure> figures = figures_of(
      sides, {"tolerances", {"tolerances.nc"}, first.force},
      fmt::format("{} over {} draws of {}", named_html(first, first.force),
                  first.tolerances->uncertain.independent_draws(), fmt::join(names, ", ")));
  const bool have_flanks = std::ranges::all_of(sides, tells_flanks);
  if (have_flanks) {
    FigureRequest flanks = {"flanks", {"tolerances.nc"}, kBothFlanks};
    if (first.is_si()) flanks.words = "share of gears that hit both flanks";
    std::ranges::move(figures_of(sides, flanks, "Share of the draws in which both flanks are hit"),
                      std::back_inserter(figures));
  }
  page->figures(figures);
  for (const ReportFindings& findings : sides) {
    const std::string worst = have_flanks ? worst_share_html(findings) : "";
    if (!worst.empty()) page->paragraph(worst);
  }
}

}  // namespace gearsweep
