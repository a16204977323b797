#include "report/report.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "model/version.hpp"
#include "plot/plot.hpp"
#include "report/detail/sections.hpp"

namespace gearsweep {

void ensure_report(const Study& study, const std::string& path) {
  if (path.ends_with(".pdf")) {
    throw InputError(fmt::format(
        "'{}': a report is a page of HTML; give -o {}html, and print that to PDF in a browser",
        path, path.substr(0, path.size() - 3)));
  }
  if (!path.ends_with(".html")) {
    throw InputError(
        fmt::format("cannot write a report to '{}': its name must end in .html", path));
  }
  ensure_writable(path);
  find_speed_axis(study);
  ensure_plottable(path.substr(0, path.size() - 4) + "svg");
}

bool write_report(const Study& study, const std::string& path, const ReportOptions& options) {
  ensure_report(study, path);
  const std::optional<ReportFindings> findings = find_for_report(study, options);
  if (!findings) return false;
  if (options.on_step) options.on_step("pictures");
  HtmlPage page(study.title.empty() ? "Report on " + study.model->name : study.title);
  add_data(*findings, &page);
  add_natural_frequencies(*findings, &page);
  add_forces(*findings, &page);
  add_worst_speeds(*findings, &page);
  add_tolerances(*findings, &page);
  add_order_map(*findings, &page);
  add_directions(*findings, &page);
  add_assumptions(*findings, &page);
  page.paragraph(fmt::format("<span class=\"small\">gearsweep {}: <code>{}</code></span>",
                             html_text(version()), html_text(options.command_line)));
  write_file(path, page.text());
  return true;
}

}  // namespace gearsweep
