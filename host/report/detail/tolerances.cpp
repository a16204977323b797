#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/detail/sections.hpp"
#include "report/detail/speeds.hpp"
#include "study/draw_quantities.hpp"

namespace gearsweep {

void add_tolerances(const ReportFindings& findings, HtmlPage* page) {
  if (!findings.tolerances) return;
  const Uncertain& uncertain = findings.tolerances->uncertain;
  page->heading("Tolerances");
  std::vector<std::string> names, maps = {findings.force};
  for (const UncertainParameter& parameter : uncertain.parameters) {
    names.push_back(html_text(parameter.draws.name));
  }
  double worst_share = 0.0, worst_forcing = 0.0;
  for (const DrawQuantity& quantity : draw_quantities(*findings.tolerances)) {
    const std::string& name = quantity.quantity.name;
    if (name != "contact_class_double_sided_share") continue;
    maps.push_back(name);
    const ResultMap share = findings.over_speed("tolerances.nc", name);
    for (std::size_t point = 0; point < share.values.size(); ++point) {
      if (!(share.values[point] > worst_share)) continue;
      worst_share = share.values[point];
      worst_forcing = findings.orders.forcing[point];
    }
  }
  page->picture(findings.drawn("tolerances", {"tolerances.nc"},
                               fmt::format("{}", fmt::join(maps, ",")), true),
                caption_of(fmt::format("{} over {} draws of {}, and the share of the draws in "
                                       "which both flanks are hit",
                                       html_text(findings.force), uncertain.independent_draws(),
                                       fmt::join(names, ", ")),
                           findings));
  if (worst_share > 0.0) {
    page->paragraph(fmt::format("Both flanks are hit most often at {}: in {:.0f} % of the draws.",
                                speed_html(findings, worst_forcing), 100.0 * worst_share));
  }
}

}  // namespace gearsweep
